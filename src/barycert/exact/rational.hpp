/// GMP's rationals out of CGAL's numbers, and MPFR's rounding to double.
#pragma once

#include <gmp.h>
#include <mpfr.h>

namespace barycert::exact {

/// GMP's rational in CGAL's exact number, whichever of its types that is.
template <class Exact>
mpq_srcptr rational(const Exact& x) {
    if constexpr (requires { x.mpq(); }) {
        return x.mpq();
    } else if constexpr (requires { x.get_mpq_t(); }) {
        return x.get_mpq_t();
    } else {
        return x.backend().data();
    }
}

/// MPFR's numbers as doubles: 53 bits, and the range that mpfr_subnormalize() wants.
class Rounder {
public:
    Rounder() { mpfr_init2(number_, 53); }
    ~Rounder() { mpfr_clear(number_); }
    Rounder(const Rounder&) = delete;
    Rounder& operator=(const Rounder&) = delete;

    /// What `set` sets the number to by one function of MPFR, whose answer it returns: to nearest, ties to even,
    /// subnormals and overflow included.
    template <class Set>
    double operator()(const Set& set) {
        const mpfr_exp_t low = mpfr_get_emin(), high = mpfr_get_emax();
        mpfr_set_emin(-1073);
        mpfr_set_emax(1024);
        const int inexact = set(number_);
        mpfr_subnormalize(number_, inexact, MPFR_RNDN);
        const double result = mpfr_get_d(number_, MPFR_RNDN);
        mpfr_set_emin(low);
        mpfr_set_emax(high);
        return result;
    }

private:
    mpfr_t number_;
};

}  // namespace barycert::exact
