/// A barrier for arithmetic beside an ExactEnvironment.
#pragma once

namespace barycert::base {

/// Returns x. Compilers move neither the computation of x nor what depends on the result across this call.
template <class T>
[[gnu::always_inline]] inline T held(T x) {
    __asm__ volatile("" : "+m"(x) : : "memory");
    return x;
}

}  // namespace barycert::base
