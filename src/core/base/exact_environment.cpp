#include <cstdint>

#include "barycert/environment.hpp"

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace barycert {

#if defined(__SSE2__)
namespace {

// MXCSR: exception flags in bits 0 to 5, denormals-are-zero 6, exception masks 7 to 12, rounding 13 and 14,
// flush-to-zero 15. The x87 control word: exception masks in bits 0 to 5, precision 8 and 9 (3: 64 bits), rounding 10
// and 11; bit 6 is reserved and set.
constexpr std::uint32_t sse_control = 0xffc0, sse_exact = 0x1f80;
constexpr std::uint16_t x87_control = 0x0f3f, x87_exact = 0x033f, x87_initial = 0x037f;

std::uint16_t x87_word() {
    std::uint16_t word;
    __asm__ volatile("fnstcw %0" : "=m"(word));
    return word;
}

/// Flags raised under other masks would trap at the next x87 instruction.
void set_x87_word(std::uint16_t word) {
    __asm__ volatile("fnclex\n\tfldcw %0" : : "m"(word) : "memory");
}

}  // namespace

bool rounds_correctly() {
    return (_mm_getcsr() & sse_control) == sse_exact && (x87_word() & x87_control) == x87_exact;
}

void ExactEnvironment::set() {
    _mm_setcsr(sse_exact);
    set_x87_word(x87_initial);
}

void ExactEnvironment::enter() {
    sse_ = _mm_getcsr();
    x87_ = x87_word();
    changed_ = true;
    set();
}

void ExactEnvironment::leave() const {
    set_x87_word(x87_);
    _mm_setcsr(sse_);
}

#else

/// Measured, as there is no register to ask that all targets have.
bool rounds_correctly() {
    return base::measured_rounding() == "nearest" && !base::measured_flush_to_zero();
}

/// FE_DFL_ENV, in which a process starts, rounds to nearest, keeps subnormals and masks exceptions (Annex F of C).
void ExactEnvironment::set() {
    std::fesetenv(FE_DFL_ENV);
}

void ExactEnvironment::enter() {
    std::fegetenv(&before_);
    changed_ = true;
    set();
}

void ExactEnvironment::leave() const {
    std::fesetenv(&before_);
}
#endif

}  // namespace barycert
