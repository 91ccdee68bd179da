/// Whether an algorithm or one before it reports an error. Many readers do nothing else when a file is bad: they return
/// success, and an empty data set.
#pragma once

#include <string>
#include <vector>

#include <vtkNew.h>
#include <vtkSmartPointer.h>

class vtkAlgorithm;
class vtkCallbackCommand;
class vtkObject;

namespace barycert::in_vtk {

/// Watches from its construction to its end. Errors are shown as if it did not.
class ErrorWatch {
public:
    explicit ErrorWatch(vtkAlgorithm& last);
    ~ErrorWatch();
    ErrorWatch(const ErrorWatch&) = delete;
    ErrorWatch& operator=(const ErrorWatch&) = delete;

    /// Who reported the first error, or has an error code; empty if none does.
    std::string error() const;

private:
    struct Watched {
        vtkSmartPointer<vtkAlgorithm> algorithm;
        unsigned long observer;
        bool shown;  ///< by another observer
    };
    void add(vtkAlgorithm& algorithm);
    static void see(vtkObject* who, unsigned long event, void* self, void* text);

    vtkNew<vtkCallbackCommand> command_;
    std::vector<Watched> watched_;
    std::string first_;
};

}  // namespace barycert::in_vtk
