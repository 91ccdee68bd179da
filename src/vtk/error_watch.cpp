#include "vtk/error_watch.hpp"

#include <algorithm>

#include <vtkAlgorithm.h>
#include <vtkCallbackCommand.h>
#include <vtkErrorCode.h>
#include <vtkOutputWindow.h>

namespace barycert::in_vtk {

ErrorWatch::ErrorWatch(vtkAlgorithm& last) {
    command_->SetCallback(see);
    command_->SetClientData(this);
    add(last);
}

ErrorWatch::~ErrorWatch() {
    for (const Watched& one : watched_) one.algorithm->RemoveObserver(one.observer);
}

// Those before it, too, each once.
void ErrorWatch::add(vtkAlgorithm& algorithm) {
    const auto same = [&](const Watched& one) { return one.algorithm == &algorithm; };
    if (std::any_of(watched_.begin(), watched_.end(), same)) return;
    const bool shown = algorithm.HasObserver(vtkCommand::ErrorEvent) != 0;
    watched_.push_back({&algorithm, algorithm.AddObserver(vtkCommand::ErrorEvent, command_), shown});
    for (int port = 0; port < algorithm.GetNumberOfInputPorts(); ++port) {
        for (int i = 0; i < algorithm.GetNumberOfInputConnections(port); ++i)
            if (vtkAlgorithm* const before = algorithm.GetInputAlgorithm(port, i)) add(*before);
    }
}

// An object that is observed does not show its errors itself.
void ErrorWatch::see(vtkObject* who, unsigned long, void* self, void* text) {
    auto& watch = *static_cast<ErrorWatch*>(self);
    if (watch.first_.empty()) watch.first_ = who->GetClassName();
    for (const Watched& one : watch.watched_)
        if (one.algorithm == who && !one.shown && text != nullptr)
            vtkOutputWindowDisplayErrorText(static_cast<const char*>(text));
}

std::string ErrorWatch::error() const {
    if (!first_.empty()) return first_;
    for (const Watched& one : watched_) {
        const unsigned long code = one.algorithm->GetErrorCode();
        if (code != vtkErrorCode::NoError)
            return one.algorithm->GetClassName() + std::string(": ") + vtkErrorCode::GetStringFromErrorCode(code);
    }
    return {};
}

}  // namespace barycert::in_vtk
