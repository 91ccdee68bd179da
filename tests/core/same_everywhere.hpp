/// Asks the same question in every floating-point environment: the answers are those of the default one, to the bit,
/// and the caller's environment is what it was before.
#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "tests/core/environments.hpp"

namespace barycert::testing_environments {

/// The control registers, without the flags of exceptions.
struct Controls {
    std::uint32_t sse = 0;
    std::uint16_t x87 = 0;

    static Controls now() {
        Controls c;
#ifdef __SSE2__
        c.sse = _mm_getcsr() & 0xffc0;
        __asm__ volatile("fnstcw %0" : "=m"(c.x87));
#else
        c.sse = static_cast<std::uint32_t>(std::fegetround());
#endif
        return c;
    }
    friend bool operator==(const Controls&, const Controls&) = default;
};

/// Answers as bits: nothing is compared or computed in the environment asked in. All NaN are one.
class Answers {
public:
    void add(double x) {
        const auto bits = std::bit_cast<std::uint64_t>(x);
        words_.push_back((bits << 1) > 0xffe0000000000000U ? 0x7ff8000000000000U : bits);
    }
    template <std::integral T>
    void add(T x) {
        words_.push_back(static_cast<std::uint64_t>(x));
    }
    void add(std::string_view text) {
        add(text.size());
        for (const char c : text) add(static_cast<int>(c));
    }
    template <class T>
    void add_all(const T& list) {
        add(list.size());
        for (const auto& x : list) add(x);
    }
    const std::vector<std::uint64_t>& words() const { return words_; }

private:
    std::vector<std::uint64_t> words_;
};

/// `ask(answers)` in every environment.
template <class Ask>
void expect_same_everywhere(const std::string& what, Ask ask) {
    Answers right;
    ask(right);
    ASSERT_FALSE(right.words().empty()) << what;
    for (const Environment& environment : all_environments()) {
        Answers got;
        Controls before, after;
        {
            const Changed changed(environment);
            before = Controls::now();
            ask(got);
            after = Controls::now();
        }
        EXPECT_TRUE(before == after) << what << " left another environment: " << environment.name;
        ASSERT_EQ(got.words().size(), right.words().size()) << what << ", " << environment.name;
        std::size_t differ = 0, first = 0;
        for (std::size_t i = got.words().size(); i-- > 0;) {
            if (got.words()[i] == right.words()[i]) continue;
            ++differ;
            first = i;
        }
        EXPECT_EQ(differ, 0U) << what << ", " << environment.name << ": first at " << first << ": " << std::hex
                              << got.words()[first] << " for " << right.words()[first];
    }
}

}  // namespace barycert::testing_environments
