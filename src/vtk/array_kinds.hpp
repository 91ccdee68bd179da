/// The arrays of a probe's output, on ranks that have them and on ranks that have not; their tuples as bytes.
#pragma once

#include <string>
#include <vector>

#include <vtkSmartPointer.h>
#include <vtkType.h>

class vtkAbstractArray;
class vtkDataSetAttributes;

namespace barycert::in_vtk {

struct ArrayKind {
    std::string name;
    bool named = true;
    int type = 0;  ///< VTK_DOUBLE, ...
    int components = 1;
    int role = -1;  ///< vtkDataSetAttributes::SCALARS, ...; -1: none
    std::vector<std::string> component_names = {};

    /// Name, type and number of components, for messages.
    std::string text() const;
};

/// Of all arrays but the one of that name, and that of ghosts.
std::vector<ArrayKind> kinds_of(vtkDataSetAttributes& attributes, const char* but);

/// Why tuples of some array cannot be sent; empty if they can.
std::string fault_of(const std::vector<ArrayKind>& kinds);

/// What differs, whatever their order; empty if nothing does.
std::string difference(const std::vector<ArrayKind>& mine, const std::vector<ArrayKind>& theirs);

std::vector<unsigned char> to_bytes(const std::vector<ArrayKind>& kinds);
std::vector<ArrayKind> kinds_from(const std::vector<unsigned char>& bytes);

/// The array of that kind; null if there is none.
vtkAbstractArray* find(vtkDataSetAttributes& attributes, const ArrayKind& kind);

/// `array`, or if it is laid out in another way a copy whose values stand one after the other.
vtkSmartPointer<vtkAbstractArray> in_standard_layout(vtkAbstractArray& array);

/// A new one; real numbers are `outside`, others zero.
vtkSmartPointer<vtkAbstractArray> make(const ArrayKind& kind, vtkIdType tuples, double outside);

/// Appends tuple `at` of an array in standard layout.
void put(vtkAbstractArray& array, vtkIdType at, std::vector<char>& bytes);

/// Sets it from what `put` appended, and returns what comes after that.
const char* take(vtkAbstractArray& array, vtkIdType at, const char* bytes);

/// Sets nothing.
const char* skip(vtkAbstractArray& array, const char* bytes);

}  // namespace barycert::in_vtk
