/// A probe whose mesh and points lie in pieces on the ranks of a job.
#pragma once

#include <vtkCharArray.h>
#include <vtkMultiProcessController.h>
#include <vtkSmartPointer.h>

#include "mesh/pieces/piece.hpp"

class vtkDataSet;

namespace barycert::in_vtk {

/// VTK's processes; one alone if there is no controller.
class Processes : public pieces::Communicator {
public:
    explicit Processes(vtkMultiProcessController* controller) : controller_(controller) {}
    int rank() const override { return controller_ != nullptr ? controller_->GetLocalProcessId() : 0; }
    int size() const override { return controller_ != nullptr ? controller_->GetNumberOfProcesses() : 1; }
    void least(std::span<double> values) override;
    void gather(std::span<const std::byte> mine, std::span<std::byte> all) override {
        controller_->AllGather(chars(mine), chars(all), count_of(mine));
    }
    void broadcast(std::span<std::byte> bytes, int from) override {
        controller_->Broadcast(chars(bytes), count_of(bytes), from);
    }
    bool send(std::span<const std::byte> bytes, int to) override {
        return controller_->Send(chars(bytes), count_of(bytes), to, tag) != 0;
    }
    bool receive(std::span<std::byte> bytes, int from) override {
        return controller_->Receive(chars(bytes), count_of(bytes), from, tag) != 0;
    }

private:
    static constexpr int tag = 0x62617279;
    static char* chars(std::span<std::byte> bytes) { return reinterpret_cast<char*>(bytes.data()); }
    static const char* chars(std::span<const std::byte> bytes) { return reinterpret_cast<const char*>(bytes.data()); }
    static vtkIdType count_of(std::span<const std::byte> bytes) { return static_cast<vtkIdType>(bytes.size()); }

    vtkMultiProcessController* controller_;
};

/// The same on all ranks.
struct ProbeSettings {
    bool categorical = false;
    double outside = 0;
    std::string mask;
    pieces::Shape cells = {};  ///< interpolation and curved
};

/// Further results on a rank.
struct ProbeReport {
    vtkSmartPointer<vtkCharArray> mask;
    std::vector<std::string> inexact;  ///< arrays of integers that become doubles first
    Notes notes;  ///< of how cells are taken and, on rank 0, that some of several ranks have no numbers
    std::uint64_t points_sent = 0, points_received = 0;
};

/// Every rank calls it. Agrees on what the pieces are pieces of (dimension, plane, numbering, arrays); then as
/// mesh/pieces/distribution.hpp says. Gives `output` the arrays of a probe at the points of `input`. An Error is the
/// same on all ranks; `output` then may have some of the arrays. `ready`: an Error if this rank has no right input or
/// source. A null source is an empty piece.
Status probe_pieces(pieces::Exchange& exchange, const ProbeSettings& settings, const Status& ready, vtkDataSet* input,
                    vtkDataSet* source, vtkDataSet* output, ProbeReport& report);

}  // namespace barycert::in_vtk
