/// What VTK has to say, kept from the terminal. Includes VTK.
#pragma once

#include <vtkCommand.h>
#include <vtkObject.h>

#include <cstddef>
#include <string>
#include <string_view>

namespace barycert::io {

/// Takes the errors and warnings of VTK objects, which else would be printed.
class Messages {
public:
    /// `object` must not outlive this.
    void listen_to(vtkObject* object) {
        object->AddObserver(vtkCommand::ErrorEvent, this, &Messages::keep);
        object->AddObserver(vtkCommand::WarningEvent, this, &Messages::keep);
    }
    /// The first one; empty if there was none.
    const std::string& first() const { return first_; }

private:
    void keep(vtkObject*, unsigned long, void* text) {
        if (!first_.empty()) return;
        // "ERROR: In FILE, line N", the object with its address, then the clause.
        std::string_view clause = text == nullptr ? "" : static_cast<const char*>(text);
        if (const std::size_t at = clause.find("): "); at != std::string_view::npos) clause.remove_prefix(at + 3);
        first_ = clause.substr(0, clause.find('\n'));
        if (first_.empty()) first_ = "an error without words";
    }
    std::string first_;
};

}  // namespace barycert::io
