/// Ranks that are threads of this process.
#pragma once

#include <barrier>
#include <condition_variable>
#include <cstring>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "mesh/pieces/exchange.hpp"

namespace barycert::testing {

class Threads {
public:
    explicit Threads(int size) : size_(size), step_(size), seen_(count()), mail_(count() * count()) {}

    /// work(communicator) on every rank at the same time.
    void run(const std::function<void(pieces::Communicator&)>& work) {
        std::vector<std::thread> threads;
        for (int r = 0; r < size_; ++r)
            threads.emplace_back([&, r] {
                Rank rank(*this, r);
                work(rank);
            });
        for (std::thread& thread : threads) thread.join();
    }
    /// From now on, one message of that rank is lost.
    void lose_one_of(int rank) { loses_ = rank; }

private:
    using Bytes = std::vector<std::byte>;
    struct Box {
        std::mutex access;
        std::condition_variable came;
        std::deque<Bytes> letters;
    };

    class Rank : public pieces::Communicator {
    public:
        Rank(Threads& all, int rank) : all_(all), rank_(rank) {}
        int rank() const override { return rank_; }
        int size() const override { return all_.size_; }
        void least(std::span<double> values) override {
            tell(std::as_bytes(values));
            for (const Bytes& other : all_.seen_) {
                for (std::size_t i = 0; i < values.size(); ++i) {
                    double its = 0;
                    std::memcpy(&its, other.data() + sizeof its * i, sizeof its);
                    if (its < values[i]) values[i] = its;
                }
            }
            all_.step_.arrive_and_wait();
        }
        void gather(std::span<const std::byte> mine, std::span<std::byte> all) override {
            tell(mine);
            for (std::size_t r = 0; r < all_.count(); ++r)
                std::memcpy(all.data() + mine.size() * r, all_.seen_[r].data(), mine.size());
            all_.step_.arrive_and_wait();
        }
        void broadcast(std::span<std::byte> bytes, int from) override {
            tell(bytes);
            const Bytes& its = all_.seen_[static_cast<std::size_t>(from)];
            std::copy(its.begin(), its.end(), bytes.begin());
            all_.step_.arrive_and_wait();
        }
        bool send(std::span<const std::byte> bytes, int to) override {
            Box& box = all_.box(rank_, to);
            {
                const std::lock_guard lock(box.access);
                box.letters.emplace_back(bytes.begin(), bytes.end());
            }
            box.came.notify_one();
            int mine = rank_;
            return !all_.loses_.compare_exchange_strong(mine, -1);
        }
        bool receive(std::span<std::byte> bytes, int from) override {
            Box& box = all_.box(from, rank_);
            std::unique_lock lock(box.access);
            box.came.wait(lock, [&] { return !box.letters.empty(); });
            const Bytes letter = std::move(box.letters.front());
            box.letters.pop_front();
            if (letter.size() != bytes.size()) return false;
            std::copy(letter.begin(), letter.end(), bytes.begin());
            return true;
        }

    private:
        // Until all have.
        void tell(std::span<const std::byte> bytes) {
            all_.seen_[static_cast<std::size_t>(rank_)].assign(bytes.begin(), bytes.end());
            all_.step_.arrive_and_wait();
        }
        Threads& all_;
        int rank_;
    };

    std::size_t count() const { return static_cast<std::size_t>(size_); }
    Box& box(int from, int to) { return mail_[static_cast<std::size_t>(from * size_ + to)]; }

    int size_;
    std::barrier<> step_;
    std::vector<Bytes> seen_;
    std::deque<Box> mail_;
    std::atomic<int> loses_{-1};
};

}  // namespace barycert::testing
