/// What the ranks of a job tell each other, so that none waits for a message that never comes.
///
/// Every rank calls the same functions in the same order. Between them each works for itself, in `attempt`, and then
/// all `agree` on whether it went well everywhere. Memory for messages is taken there, too: sizes go before contents.
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <new>
#include <span>
#include <vector>

#include "barycert/result.hpp"

class vtkMultiProcessController;

namespace barycert::in_vtk {

/// The Status that `work` returns, or an Error for what it throws.
template <class Work>
Status attempt(Work&& work) {
    try {
        return work();
    } catch (const std::bad_alloc&) {
        return Error{.what = "out of memory"};
    } catch (const std::exception& e) {
        return Error{.what = e.what()};
    }
}

/// Values for, or from, each partner: those of partner k stand from begin[k] to begin[k + 1].
template <class T>
struct Parcels {
    std::vector<std::size_t> begin{0};
    std::vector<T> values;

    std::size_t count() const { return begin.size() - 1; }
    std::size_t size(std::size_t k) const { return begin[k + 1] - begin[k]; }
    std::span<const T> of(std::size_t k) const { return std::span<const T>(values).subspan(begin[k], size(k)); }
    /// What was added to `values` since the last call is for the next partner.
    void close() { begin.push_back(values.size()); }
};

class Exchange {
public:
    static constexpr std::size_t few = 8;

    /// Of one process alone if there is no controller. `chunk`: bytes of the longest message.
    explicit Exchange(vtkMultiProcessController* controller, std::size_t chunk = std::size_t{1} << 30);

    int rank() const { return rank_; }
    int size() const { return size_; }

    /// Done if it is on every rank; else the Error of the lowest rank that has one, the same on all.
    Status agree(const Status& mine);
    /// As agree(attempt(work)).
    template <class Work>
    Status everywhere(Work&& work) {
        return agree(attempt(work));
    }

    /// Over all ranks, for each of the values, of which there are few.
    void greatest(std::span<int> values);
    void least(std::span<double> values);
    /// The values of all ranks one after the other; `all` has room for them.
    void gather(std::span<const double> mine, std::span<double> all);
    /// Those of that rank; those of others are replaced, after room for them was found everywhere.
    Status broadcast(std::vector<unsigned char>& bytes, int from);

    /// Whom this rank exchanges messages with, in the order in which it does; each of them names this rank, too.
    void set_partners(std::vector<int> ranks);
    const std::vector<int>& partners() const { return partners_; }

    /// Messages to and from each partner. Sizes are known if `in` has its parts already, on all ranks.
    template <class T>
    Status swap(const Parcels<T>& out, Parcels<T>& in, bool sizes_known = false) {
        if (!sizes_known) {
            std::vector<std::uint64_t> sizes;
            if (Status done = swap_sizes(out.begin, sizes); !done) return done;
            Status room = everywhere([&]() -> Status {
                in.begin.assign(1, 0);
                for (const std::uint64_t size : sizes) in.begin.push_back(in.begin.back() + size);
                in.values.resize(in.begin.back());
                return Done{};
            });
            if (!room) return room;
        }
        return agree(swap_bytes(std::as_bytes(std::span(out.values)), out.begin,
                                std::as_writable_bytes(std::span(in.values)), in.begin, sizeof(T)));
    }

    /// Bytes of this rank's messages to partners, and of what all ranks gathered and broadcast.
    std::uint64_t sent() const { return sent_; }
    std::uint64_t gathered() const { return gathered_; }

private:
    Status swap_sizes(std::span<const std::size_t> begin, std::vector<std::uint64_t>& sizes);
    Status swap_bytes(std::span<const std::byte> out, std::span<const std::size_t> out_begin, std::span<std::byte> in,
                      std::span<const std::size_t> in_begin, std::size_t width);
    bool send(const std::byte* bytes, std::size_t count, int to);
    bool receive(std::byte* bytes, std::size_t count, int from);

    vtkMultiProcessController* controller_;
    std::size_t chunk_;
    int rank_ = 0, size_ = 1;
    std::vector<int> partners_;
    std::uint64_t sent_ = 0, gathered_ = 0;
};

}  // namespace barycert::in_vtk
