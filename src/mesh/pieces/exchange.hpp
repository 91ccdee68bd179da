/// Exchange of messages between the ranks of a job, such that none waits for a message that never comes.
///
/// Every rank calls the same functions in the same order. Between them each works for itself, in `attempt`, and then
/// all `agree` on whether it went well everywhere. Memory for messages is taken there, too: sizes go before contents.
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <new>
#include <span>
#include <type_traits>
#include <vector>

#include "barycert/result.hpp"

namespace barycert::pieces {

/// How ranks reach each other: MPI, threads, or whatever an engine has. All ranks call the same function at the same
/// time; but `send` and `receive` are of two ranks alone. No call needs memory of its own. With one rank alone, only
/// rank() and size() are called.
class Communicator {
public:
    virtual ~Communicator() = default;
    virtual int rank() const = 0;
    virtual int size() const = 0;
    /// Each value becomes the least of all ranks.
    virtual void least(std::span<double> values) = 0;
    /// The bytes of all ranks one after the other, as many of each.
    virtual void gather(std::span<const std::byte> mine, std::span<std::byte> all) = 0;
    /// The bytes become those of that rank.
    virtual void broadcast(std::span<std::byte> bytes, int from) = 0;
    /// False if the message is lost.
    virtual bool send(std::span<const std::byte> bytes, int to) = 0;
    virtual bool receive(std::span<std::byte> bytes, int from) = 0;
};

/// The Status that `work` returns, Done if it returns nothing, or an Error for what it throws.
template <class Work>
Status attempt(Work&& work) {
    try {
        if constexpr (std::is_void_v<decltype(work())>) {
            work();
            return Done{};
        } else {
            return work();
        }
    } catch (const std::bad_alloc&) {
        return Error{.code = "memory.short", .what = "out of memory"};
    } catch (const std::exception& e) {
        return Error{.code = "internal.error", .what = e.what()};
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
    /// Ends what is for this partner: all that was added to `values` since the last call. The rest is for the next.
    void close() { begin.push_back(values.size()); }
};

class Exchange {
public:
    /// `chunk`: bytes of the longest message.
    explicit Exchange(Communicator& ranks, std::size_t chunk = std::size_t{1} << 30) : ranks_(ranks), chunk_(chunk) {}

    int rank() const { return ranks_.rank(); }
    int size() const { return ranks_.size(); }

    /// Done if it is on every rank; else the Error of the lowest rank that has one, the same on all.
    Status agree(const Status& mine);
    /// As agree(attempt(work)).
    template <class Work>
    Status everywhere(Work&& work) {
        return agree(attempt(work));
    }

    /// Each value becomes the least of all ranks.
    void least(std::span<double> values);
    /// One of each rank; `all` has room for them.
    template <class T>
    void gather(const T& mine, std::vector<T>& all) {
        if (size() == 1) {
            all[0] = mine;
            return;
        }
        ranks_.gather(std::as_bytes(std::span(&mine, 1)), std::as_writable_bytes(std::span(all)));
        gathered_ += sizeof(T) * all.size();
    }
    /// Sends that rank's bytes to all. Replaces those of the others after room for them was found everywhere.
    Status broadcast(std::vector<unsigned char>& bytes, int from);

    /// Sets the ranks with which this rank exchanges messages; partners() returns them in the order of the exchanges.
    /// Requires: each of them names this rank, too.
    void set_partners(std::vector<int> ranks);
    const std::vector<int>& partners() const { return partners_; }

    /// Messages to and from each partner. Sizes are known if `in` has its parts already, on all ranks.
    template <class T>
    Status swap(const Parcels<T>& out, Parcels<T>& in, bool sizes_known = false) {
        if (!sizes_known) {
            Parcels<std::uint64_t> mine{{}, {}}, theirs{{}, {}};  // memory is taken in `everywhere` alone
            Status room = everywhere([&] {
                mine.close();
                for (std::size_t k = 0; k < partners_.size(); ++k) {
                    mine.values.push_back(out.size(k));
                    mine.close();
                }
                theirs = mine;
            });
            if (!room) return room;
            if (Status done = swap(mine, theirs, true); !done) return done;
            room = everywhere([&] {
                in.begin.assign(1, 0);
                for (const std::uint64_t size : theirs.values) in.begin.push_back(in.begin.back() + size);
                in.values.resize(in.begin.back());
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
    Status swap_bytes(std::span<const std::byte> out, std::span<const std::size_t> out_begin, std::span<std::byte> in,
                      std::span<const std::size_t> in_begin, std::size_t width);

    Communicator& ranks_;
    std::size_t chunk_;
    std::vector<int> partners_;
    std::uint64_t sent_ = 0, gathered_ = 0;
};

}  // namespace barycert::pieces
