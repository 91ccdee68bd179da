#include "vtk/exchange.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include <vtkCommunicator.h>
#include <vtkMultiProcessController.h>

namespace barycert::in_vtk {

namespace {

constexpr int tag = 0x62617279;

// Without memory of its own, for others wait.
template <class T>
std::array<T, Exchange::few> copy_of(std::span<const T> values) {
    std::array<T, Exchange::few> copy{};
    std::copy(values.begin(), values.end(), copy.begin());
    return copy;
}

}  // namespace

Exchange::Exchange(vtkMultiProcessController* controller, std::size_t chunk) : controller_(controller), chunk_(chunk) {
    if (controller_ == nullptr) return;
    rank_ = controller_->GetLocalProcessId();
    size_ = controller_->GetNumberOfProcesses();
}

Status Exchange::agree(const Status& mine) {
    if (size_ == 1) return mine;
    const int bad = mine ? size_ : rank_;
    int first = size_;
    controller_->AllReduce(&bad, &first, 1, vtkCommunicator::MIN_OP);
    gathered_ += sizeof bad;
    if (first == size_) return Done{};
    // No memory may be left: the text has a place of its own.
    std::array<char, 1024> text{};
    if (rank_ == first) {
        const std::string message = mine.error().message();
        message.copy(text.data(), text.size() - 1);
    }
    controller_->Broadcast(text.data(), static_cast<vtkIdType>(text.size()), first);
    gathered_ += text.size();
    return Error{.what = "rank " + std::to_string(first) + ": " + text.data()};
}

void Exchange::greatest(std::span<int> values) {
    if (size_ == 1) return;
    const auto mine = copy_of<int>(values);
    controller_->AllReduce(mine.data(), values.data(), static_cast<vtkIdType>(values.size()), vtkCommunicator::MAX_OP);
    gathered_ += values.size_bytes();
}

void Exchange::least(std::span<double> values) {
    if (size_ == 1) return;
    const auto mine = copy_of<double>(values);
    controller_->AllReduce(mine.data(), values.data(), static_cast<vtkIdType>(values.size()), vtkCommunicator::MIN_OP);
    gathered_ += values.size_bytes();
}

void Exchange::gather(std::span<const double> mine, std::span<double> all) {
    if (size_ == 1) {
        std::copy(mine.begin(), mine.end(), all.begin());
        return;
    }
    controller_->AllGather(mine.data(), all.data(), static_cast<vtkIdType>(mine.size()));
    gathered_ += all.size_bytes();
}

Status Exchange::broadcast(std::vector<unsigned char>& bytes, int from) {
    if (size_ == 1) return Done{};
    unsigned long long count = bytes.size();
    controller_->Broadcast(&count, 1, from);
    Status room = everywhere([&]() -> Status {
        if (rank_ != from) bytes.resize(count);
        return Done{};
    });
    if (!room) return room;
    if (count > 0) controller_->Broadcast(bytes.data(), static_cast<vtkIdType>(count), from);
    gathered_ += sizeof count + count;
    return Done{};
}

// In the order of rank XOR partner, every pair has the same place with both, and a rank no two pairs in one place. So
// the first pair that is not done can always go on. The pairs of one place meet at the same time.
void Exchange::set_partners(std::vector<int> ranks) {
    partners_ = std::move(ranks);
    std::sort(partners_.begin(), partners_.end(), [this](int a, int b) { return (a ^ rank_) < (b ^ rank_); });
}

bool Exchange::send(const std::byte* bytes, std::size_t count, int to) {
    sent_ += count;
    for (std::size_t at = 0; at < count; at += chunk_) {
        const auto some = static_cast<vtkIdType>(std::min(chunk_, count - at));
        if (controller_->Send(reinterpret_cast<const char*>(bytes + at), some, to, tag) == 0) return false;
    }
    return true;
}

bool Exchange::receive(std::byte* bytes, std::size_t count, int from) {
    for (std::size_t at = 0; at < count; at += chunk_) {
        const auto some = static_cast<vtkIdType>(std::min(chunk_, count - at));
        if (controller_->Receive(reinterpret_cast<char*>(bytes + at), some, from, tag) == 0) return false;
    }
    return true;
}

Status Exchange::swap_sizes(std::span<const std::size_t> begin, std::vector<std::uint64_t>& sizes) {
    std::vector<std::uint64_t> mine;
    std::vector<std::size_t> each;
    Status room = everywhere([&]() -> Status {
        sizes.resize(partners_.size());
        for (std::size_t k = 0; k <= partners_.size(); ++k) each.push_back(k);
        for (std::size_t k = 0; k < partners_.size(); ++k) mine.push_back(begin[k + 1] - begin[k]);
        return Done{};
    });
    if (!room) return room;
    return agree(swap_bytes(std::as_bytes(std::span(mine)), each, std::as_writable_bytes(std::span(sizes)), each,
                            sizeof(std::uint64_t)));
}

Status Exchange::swap_bytes(std::span<const std::byte> out, std::span<const std::size_t> out_begin,
                            std::span<std::byte> in, std::span<const std::size_t> in_begin, std::size_t width) {
    bool went_well = true;
    for (std::size_t k = 0; k < partners_.size(); ++k) {
        const int other = partners_[k];
        const auto give = [&] {
            const std::byte* const from = out.data() + width * out_begin[k];
            went_well = send(from, width * (out_begin[k + 1] - out_begin[k]), other) && went_well;
        };
        const auto take = [&] {
            std::byte* const to = in.data() + width * in_begin[k];
            went_well = receive(to, width * (in_begin[k + 1] - in_begin[k]), other) && went_well;
        };
        if (rank_ < other) {
            give();
            take();
        } else {
            take();
            give();
        }
    }
    if (!went_well) return Error{.what = "a message to or from another rank was lost"};
    return Done{};
}

}  // namespace barycert::in_vtk
