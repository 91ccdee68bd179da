#include "barycert/environment.hpp"

#if defined(__SSE2__)
#include <xmmintrin.h>
#else
#include <cfloat>
#endif

#include "barycert/base/strict_math.hpp"

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
namespace {

double volatile_value(double x) {
    volatile double v = x;
    return v;
}

}  // namespace

/// Measured, as there is no register to ask that all targets have: 1 + 2^-54 and 1 + 3 * 2^-54 lie on either side of
/// the middle between 1 and its upper neighbour, and only to nearest go apart, on both sides of zero.
bool rounds_correctly() {
    const double one = volatile_value(1), under = volatile_value(0x1p-54), over = volatile_value(0x3p-54);
    const bool nearest = volatile_value(one + under) == 1 && volatile_value(one + over) > 1 &&
                         volatile_value(-one - under) == -1 && volatile_value(-one - over) < -1;
    const bool results = volatile_value(volatile_value(DBL_MIN) * 0.5) != 0;
    const bool operands = volatile_value(volatile_value(0x1p-1074) * 0x1p+200) != 0;
    return nearest && results && operands;
}

/// FE_DFL_ENV is the environment in which a process starts; by IEC 60559 (Annex F of the C standard) it rounds to
/// nearest, keeps subnormals and masks exceptions.
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
