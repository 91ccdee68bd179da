"""Why mutants survive."""
F, R, E, I, S = ("filter-inl.hpp", "refinement-inl.hpp", "error_free-inl.hpp", "integer.hpp", "scaled_double.hpp")
X, Q, P = "exact_weights.cpp", "quotient.cpp", "predicates.cpp"


def climbed(error, killed):
    return (f"Slack: the bound counts every rounding with its worst sign and every term at its largest. Climbing found "
            f"errors up to {error}; {killed} in its place is killed.")


def down_to(killed):
    return f"Slack: near-ties made by construction tell nothing above {killed}, which is killed."


COVERED = "Slack, by the runs and not by proof: other parts of the same bound cover it in all near-ties of the killer. "
TO_INFINITY = ("Slack: this limit is against overflow. Values and weights run to nearest alone, where what overflows is "
               "infinite; a remainder or the bound then is infinite or NaN, and the case uncertain.")
BOTH_SIDES = "Equivalent for answers: a guard with room on both sides of its end; a case exactly on it goes to the other tier."
STRICT = ("Equivalent for answers: the bound is larger than the error it is for by 2 % at least, so what lies exactly on it "
          "may be certain or not.")
# Listed mutants: file, part of the text that is changed, replacement or "", explanation.
LISTED = [
    (F, "times(49, product)", "times(24, product)", climbed("9.0 e X Y Z", "7")),
    (F, "times(49, product)", "times(10, product)", climbed("9.0 e X Y Z", "7")),
    (F, "times(245, product)", "times(60, product)", climbed("11.7 e X Y Z", "7")),
    (F, "times(8.5, product)", "times(4, product)", climbed("4.0 e X Y", "2")),
    (F, "times(37, product)", "times(9, product)", climbed("3.3 e X Y", "2")),
    (F, "times(5.5, p)", "times(2.5, p)", climbed("1.6 e P", "1")),
    (F, "times(4 * 11.5, p)", "times(4 * 5, p)", climbed("4 * 0.53 e P", "4 * 0.25")),
    (F, "times(4 * 11.5, q)", "", "Slack, observed down to 0: where N.N vanishes the computed N is of the order of e, so "
     "that no numerator N.m gets above its own bound, and that check rejects the case. Not proven: not covered."),
    (F, "filter_epsilon", "filter_epsilon = 0x1p-53", "Slack: no error above half of its bound was found for any constant; "
     "2^-56 is killed."),
    (R, "constant(4 * u)", "", "Slack: the factor 4 is for the last weight, whose error is at most that of "
     "all others and a little more. A hundredth of the residual's part is killed."),
    (R, "constant(100) * k", "constant(10) * k", down_to("1")),
    (R, "constant(50))", "", "Slack: k = G / |d| is at least 1/4, so that 100 k, of which a tenth suffices in the runs, is at "
     "least 25."),
    (R, "constant(4 * 172 * u * u)", "", down_to("0.1")),
    (R, "hn::Le(max_size, constant(0x1p900))", "", TO_INFINITY),
    (R, "hn::Le(g, constant(", "", TO_INFINITY),
    (R, "within(tag, k, 0.125, 0x1p36)", "within(tag, k, 0.0, 0x1p36)",
     "Equivalent: |d| <= 4.01 G unless d overflows, which the limit on G excludes."),
    (R, "hn::Le(out.magnitude, constant(0x1p100))", "", "Slack: the bound grows with the weights; " + TO_INFINITY[7:]),
    (R, "18 * u * u / (5.5", "", down_to("0.25")),
    (R, "44 * u * u / (11.5", "", down_to("0.5")),
    (R, "constant(18 * u * u) * f.denominator.high", "", COVERED + "P is of the order of the largest weight times N.N."),
    (R, "max_weight * denominator_error", "hn::Zero(tag)", COVERED + "P is of the order of the largest weight times N.N."),
    (R, "constant(1.02)", "", down_to("0.03")),
    (R, "constant(26 * u * u) * max_weight", "", COVERED + "The numerator's part alone is at least 18 u^2 P / |d|."),
    (R, "hn::Le(denominator_error, constant", "hn::Le(denominator_error, constant(0x1p200) * f.denominator.high)",
     "Slack: where N.N is lost in its error the weights' bound is as large as they are, and their two ends round differently."),
    (R, "hn::Set(tag, 0x1p-52) * hn::Abs(y)", "hn::Zero(tag)", COVERED + "|c| is of the order of u, this part of "
     "u^2."),
    (R, "hn::Set(tag, 1 + 0x1p-40) * error", "", down_to("2^-6")),
    (R, "hn::Set(tag, n) * r.error", "r.error", "Slack: one weight's bound, four times too large for all but the last, "
     "covers the sum; a 64th of it is killed."),
    (R, "hn::Set(tag, n) * r.error", "", COVERED),
    (R, "hn::Set(tag, 0x1p-98)", "", COVERED + "n times the weights' bound, in the same sum, is larger."),
    (R, "0x1p-800, 0x1p900)", "", TO_INFINITY),
    (R, "error, certain) +", "", "Equivalent: the last sum is of two numbers of different sign where it is zero, and that "
     "is +0 to nearest; or of zeros, of which the sum of remainders is a positive one."),
    (E, "0x1p27 + 1", "", "Slack: the parts are a bit longer or shorter, the remainder off by its own last bits, far below "
     "the bounds."),
    (I, "if (order == 0) return {};", "", "Equivalent: the difference of equal magnitudes is trimmed to zero, whose sign "
     "means nothing."),
    (I, "if (a.limbs_[i] == 0) continue;", "", "Performance only: a row of zeros adds nothing."),
    (S, "bits <= 64 - room", "bits <= 64 - (room - 1)) return f", "Slack for triangles and tetrahedra (a 3x3 "
     "determinant of entries below M is below 4 M^3, and a sum in two's complement is right if its result fits); not "
     "covered for segments and triangles in space."),
    (S, "bits <= 64 - room", "", "Performance only, where it is stricter; slack where not: the bound has room for a sum of all terms "
     "at their largest."),
    (S, "bits <= 128 - room", "", "As with one limb."),
    (X, "unit.bits()", "", "Performance only, where it is stricter; else not covered."),
    (S, "m == 0 ? ScaledDouble::none", "", "Performance only: zeros then count for the unit, which gets smaller than it need be."),
    (S, "x.mantissa == 0 ? 0 : above", "", "Performance only: the width then is taken for larger than it is."),
    (P, "8.5 * epsilon", "4 * epsilon", climbed("4.0 e X Y", "1.5")),
    (P, "49 * epsilon", "24 * epsilon", climbed("9.0 e X Y Z", "5")),
]

# Generated mutants: file, part of the line, replacement or "", explanation.
GENERATED = [
    (R, "out.error = scale *", "-", "Slack: the two parts seldom are alike, their difference is of the size of the larger, and a "
     "negative bound only exchanges the two ends."),
    (E, "const V s = x + y;", "-", "Slack: of quick_two_sum, which then gives x - y and 2 y: the same sum, a bit longer in its low part."),
    (F, "const V square", "", "Performance only: a smaller square leaves more cases to the last tier."),
    (F, "if (i > 0)", "", "Equivalent where compiled: what goes to the row before the first is overwritten after."),
    (R, "if (i > 0)", "", "Equivalent where compiled: what goes to the row before the first is overwritten after."),
    (R, "out.magnitude = out.magnitude + ", "", "Slack: serves as a guard against overflow, and in the 2^-98 of a value, which other parts cover."),
    ("lanes.cpp", "x * x + y == 0x1p-60", "", "Not covered here: the report on the environment alone reads it, which is not among "
     "the sources compiled anew."),
    ("numerators-inl.hpp", "T e[projected", "", "No mutant proper: the length of an array; extents then count rows that were never set."),
    (I, "x.size_ <= y.size_ ?", "", "Performance only: which factor is the outer one."),
    (I, "x.size_ >= y.size_", "", "Equivalent: of two numbers of as many limbs either may come first."),
    (I, "order > 0", "", "Equivalent: order is not 0 there."),
    ("blocks.hpp", "first < blocks.count", "", "Equivalent: one block of no cases more."),
    (P, "std::fabs(det) > ", ">=", STRICT),
    (P, "extent >= 0x1p-300", "", BOTH_SIDES),
    (P, "det < 0 ?", "<=", "Equivalent: det is not zero there."),
    (F, "hn::G", "", STRICT),
    (F, "hn::L", "", BOTH_SIDES),
    (R, "hn::L", "", BOTH_SIDES),
    (R, "hn::G", "", BOTH_SIDES),
    (Q, "number.sign() < 0", "", "Equivalent: round_quotient returns +0 for zero before it looks at the sign."),
]
