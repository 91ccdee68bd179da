/// The arrays of a probe's output, on ranks that have them and on ranks that have not; their tuples as bytes.
#pragma once

#include <string>
#include <vector>

#include <vtkSmartPointer.h>
#include <vtkType.h>

#include "barycert/pieces/distribution.hpp"

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
    /// The array of this kind; null if there is none.
    vtkAbstractArray* in(vtkDataSetAttributes& attributes) const;
    /// A new one; real numbers are `outside`, others zero.
    vtkSmartPointer<vtkAbstractArray> make(vtkIdType tuples, double outside) const;
};

/// Of all arrays but the one of that name, and that of ghosts.
std::vector<ArrayKind> kinds_of(vtkDataSetAttributes& attributes, const char* but);

/// Why tuples of some array cannot be sent; empty if they can.
std::string fault_of(const std::vector<ArrayKind>& kinds);

/// What differs, whatever their order; empty if nothing does.
std::string difference(const std::vector<ArrayKind>& mine, const std::vector<ArrayKind>& theirs);

std::vector<unsigned char> to_bytes(const std::vector<ArrayKind>& kinds);
std::vector<ArrayKind> kinds_from(const std::vector<unsigned char>& bytes);

/// Of arrays whose values stand one after the other, of bits, and of texts.
struct ArrayTuples : pieces::Tuples {
    void put(std::size_t tuple, std::vector<char>& bytes) const override;
    const char* take(std::size_t tuple, const char* bytes, bool set) override;

    std::vector<vtkSmartPointer<vtkAbstractArray>> arrays;
};

}  // namespace barycert::in_vtk
