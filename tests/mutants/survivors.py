"""Why mutants survive: (file, part of the source line or of the changed text, replacement or "", explanation)."""
F, R, E, I = "filter-inl.hpp", "refinement-inl.hpp", "error_free-inl.hpp", "integer.hpp"
HALF = ("Slack: the bound counts every rounding with its worst sign and every term at its largest. Climbing in each "
        "rounding mode found errors up to %s; the next lower constant in the list is told below as killed or not.")
NOT_REACHED = ("No case found: near-ties in the killer do not reach the error that this constant is proven for while the "
               "other parts of the bound stand. Not proven equivalent.")
OVERFLOW = ("No case found. To nearest, what overflows is infinite or NaN and so uncertain; in directed rounding it stops at "
            "the largest double, so this is not proven equivalent.")
STRICT = ("Equivalent: the bound is larger than the error it is for by 2 % at least, so what lies exactly on it may be "
          "certain or not.")
EXPLANATIONS = [
    (F, "times(49, product)", "times(24, product)", HALF % "9.0 e X Y Z"),
    (F, "times(245, product)", "times(60, product)", HALF % "11.7 e X Y Z"),
    (F, "times(8.5, product)", "times(4, product)", HALF % "4.0 e X Y"),
    (F, "times(37, product)", "times(9, product)", HALF % "3.3 e X Y"),
    (F, "times(5.5, p)", "times(2.5, p)", HALF % "1.6 e P"),
    (F, "times(4 * 11.5, p)", "times(4 * 5, p)", HALF % "4 * 0.53 e P"),
    (F, "times(4 * 11.5, q)", "", "Slack: where N.N is zero, the computed N is of the order of e, so that all numerators "
     "N.m stay below their own bound. The numerators' check alone rejects such cases; the constant could be 0."),
    (F, "filter_epsilon", "filter_epsilon = 0x1p-53", HALF % "less than half of each constant"),
    (F, "0x1p-300, 0x1p1000", "", OVERFLOW),
    (F, "all_within(tag, r, 0x1p-300, 0x1p300)", "all_within(tag, r, 0x1p-300, 0x1p1000)", OVERFLOW),
    (F, "hn::Set(tag, 0x1p-400)", "hn::Set(tag, 0x1p-1000)", "Slack with gradual underflow: what is lost is then below "
     "2^-1070, and e P at least 2^-1053. With flush-to-zero a loss of 2^-1022 may exceed it; lower ends are killed."),
    (R, "constant(4 * u)", "constant(1 * u)", "Slack: the factor 4 is for the last weight, whose error is at most the sum of the others'; " + NOT_REACHED),
    (R, "constant(100) * k", "", NOT_REACHED),
    (R, "constant(50))", "", NOT_REACHED),
    (R, "constant(4 * 172 * u * u)", "constant(4 * 1 * u * u)", "Slack: near-ties reach errors of about 1 u^2 (1 + L) B(V)/|d|; a hundredth of it is killed."),
    (R, "0x1p-200, 0x1p200", "all_within(tag, x, 0x1p-200, 0x1p1000)", OVERFLOW),
    (R, "0x1p-200, 0x1p200", "", "Slack: results that overflow are infinite or NaN, and so uncertain."),
    (R, "all_within(tag, magnitude, 0, 0x1p300)", "", "Slack: with extents below 2^200 a vertex above 2^300 has lost all of "
     "its extent; the bound then is larger than any weight."),
    (R, "hn::Le(out.magnitude, constant(0x1p100))", "", "Slack: the bound grows with L; the guard is for overflow, which "
     "ends in infinite or NaN and so uncertain."),
    (R, "18 * u * u / (5.5", "", NOT_REACHED),
    (R, "44 * u * u / (11.5", "", NOT_REACHED),
    (R, "constant(18 * u * u) * f.denominator.high", "", NOT_REACHED),
    (R, "largest * denominator_error", "hn::Zero(tag)", NOT_REACHED),
    (R, "constant(1.02)", "", NOT_REACHED),
    (R, "constant(26 * u * u) * largest", "", NOT_REACHED),
    (R, "hn::Le(denominator_error", "", "Slack: where N.N is lost in its error, the weights' error is as large as they are; "
     "their two ends then round differently."),
    (R, "hn::Set(tag, 0x1p-52) * hn::Abs(r.correction[i])", "hn::Zero(tag)", NOT_REACHED),
    (R, "hn::Set(tag, 1 + 0x1p-40) * r.error", "", NOT_REACHED),
    (R, "hn::Set(tag, n) * r.error", "r.error", "Slack: the error of one weight, four times too large for all but the last, covers the sum."),
    (R, "hn::Set(tag, 0x1p-98)", "", "Slack: n times the weights' error, in the same sum, is larger than this part."),
    (R, "hn::Set(tag, 0x1p900)", "", "Slack: beyond, the split and products overflow to infinite or NaN, and so uncertain."),
    (R, "hn::Set(tag, 0x1p-800)", "", "Slack: what underflow loses is below the bound unless the value itself is near 2^-1022."),
    (R, "error, certain) + hn::Zero(tag)", "", "Equivalent with x - x = +0: an exact zero is the sum of a number and its negative."),
    (E, "0x1p27 + 1", "", "Slack: the parts are then a bit longer, the remainder off by the last bit of a remainder, far below the bounds."),
    (E, "hn::MulSub", "", "Not compiled on the target of this run."),
    (I, "if (order == 0) return {};", "", "Equivalent: the difference of equal magnitudes is trimmed to zero, whose sign means nothing."),
    (I, "if (a.limbs_[i] == 0) continue;", "", "Equivalent: a row of zeros adds nothing. Speed alone."),
    ("blocks.hpp", "block_size + lanes::slack", "", "Undefined behaviour at worst: one vector of numbers behind the array, which the stack happened to have room for."),
    ("scaled_double.hpp", "8 : 72", "std::is_same_v<T, Fixed<1>> ? 8 : 73", "Slack: coordinates below 2^126 in two limbs need cells whose "
     "numerators use every bit of the bound 3 * 2^(64 N - 2) * ..., which none of the cases does; 75 is killed."),
    ("scaled_double.hpp", "8 : 72", "std::is_same_v<T, Fixed<1>> ? 9 : 72", "Slack: as with two limbs."),
    ("scaled_double.hpp", "std::min(std::max(-shift, 0), 63)", "", "Equivalent or nearly: a double has 53 bits, so that shifts beyond lose all of it."),
    ("quotient.cpp", "number.sign() < 0", "", "Equivalent: round_quotient returns +0 for zero before it looks at the sign."),
    ("scaled_double.hpp", "std::max(biased_exponent(x), 1)", "", "Equivalent for the range: zeros and subnormals then count as 0, and a number's own "
     "exponent is at least 1; the unit of one limb moves by one bit."),
    ("predicates.cpp", "std::fabs(det) > 8.5", "std::fabs(det) > 8.5", "No case found, against what the range is for (orient3d without one is killed)."),
    (F, "hn::G", "", STRICT),
    (F, "hn::Le(most", "", "Equivalent: ranges are wide on both sides of their ends."),
    (R, "hn::L", "", "Equivalent: guards have room on both sides of their ends."),
    (R, "hn::G", "", "Equivalent: guards have room on both sides of their ends."),
    ("predicates.cpp", "8.5 * epsilon", "4 * epsilon", HALF % "4.0 e X Y"),
    ("predicates.cpp", "49 * epsilon", "24 * epsilon", HALF % "9.0 e X Y Z"),
    ("predicates.cpp", "std::fabs(det) > ", ">=", STRICT),
    ("predicates.cpp", "extent >= 0x1p-300", "", "Equivalent: the range has room on both sides of its ends."),
    ("predicates.cpp", "det < 0 ? -1 : 1", "<=", "Equivalent: det is not zero there."),
    (I, "carry", "", "See the integer's own tests."),
]
