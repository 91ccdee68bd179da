"""What is changed: mutants that are listed, and those made by exchanging comparisons and signs."""
import re

F, R, Q, X, S, I, E = ("filter-inl.hpp", "refinement-inl.hpp", "quotient.cpp", "exact_weights.cpp",
                       "scaled_double.hpp", "integer.hpp", "error_free-inl.hpp")
# (file, exact text, occurrence, replacement, why)
EXPLICIT = [
    # the filter's constants, at half, and at what a case is known for
    (F, "times(49, product)", 0, "times(24, product)", "half the bound of a tetrahedron's numerator"),
    (F, "times(49, product)", 0, "times(10, product)", "an error of 9 e is known"),
    (F, "times(49, product)", 0, "times(7, product)", "an error of 9 e is known"),
    (F, "times(49, product)", 0, "times(0, product)", "no bound"),
    (F, "times(245, product)", 0, "times(60, product)", "a quarter of the bound of a tetrahedron's volume"),
    (F, "times(245, product)", 0, "times(7, product)", "an error of 11 e is known"),
    (F, "times(245, product)", 0, "times(0, product)", "no bound"),
    (F, "times(8.5, product)", 0, "times(4, product)", "half the bound of a triangle's numerator"),
    (F, "times(8.5, product)", 0, "times(2, product)", "an error of 4 e is known"),
    (F, "times(8.5, product)", 0, "times(0, product)", "no bound"),
    (F, "times(37, product)", 0, "times(9, product)", "a quarter of the bound of a triangle's area"),
    (F, "times(37, product)", 0, "times(2, product)", "an error of 3.3 e is known"),
    (F, "times(37, product)", 0, "times(0, product)", "no bound"),
    (F, "times(5.5, p)", 0, "times(2.5, p)", "half the bound of a segment's numerator"),
    (F, "times(5.5, p)", 0, "times(1, p)", "an error of 1.6 e is known"),
    (F, "times(5.5, p)", 0, "times(0, p)", "no bound"),
    (F, "times(4 * 11.5, p)", 0, "times(4 * 5, p)", "half the bound of a triangle3d's numerator"),
    (F, "times(4 * 11.5, p)", 0, "times(4 * 0.25, p)", "an error of 4 * 0.5 e is known"),
    (F, "times(4 * 11.5, p)", 0, "times(0, p)", "no bound"),
    (F, "times(4 * 11.5, q)", 0, "times(4 * 5, q)", "half the bound of N.N"),
    (F, "times(4 * 11.5, q)", 0, "times(0, q)", "no bound"),
    (F, "filter_epsilon = 0x1p-52", 0, "filter_epsilon = 0x1p-53", "the unit of rounding to nearest alone"),
    (F, "filter_epsilon = 0x1p-52", 0, "filter_epsilon = 0x1p-56", "a sixteenth of every bound"),
    # its ranges
    (F, "all_within(tag, r, 0x1p-300, 0x1p300)", 0, "all_within(tag, r, 0x1p-1000, 0x1p300)", "tetrahedron: underflow"),
    (F, "all_within(tag, r, 0x1p-300, 0x1p300)", 0, "all_within(tag, r, 0x1p-300, 0x1p1000)", "tetrahedron: overflow"),
    (F, "all_within(tag, r, 0x1p-300, 0x1p300)", 0, "all_within(tag, r, 0.0, 1e308)", "tetrahedron: no range"),
    (F, "all_within(tag, r, 0x1p-300, 0x1p300)", 1, "all_within(tag, r, 0x1p-1000, 0x1p300)", "triangle: underflow"),
    (F, "all_within(tag, r, 0x1p-300, 0x1p300)", 1, "all_within(tag, r, 0x1p-300, 0x1p1000)", "triangle: overflow"),
    (F, "all_within(tag, r, 0x1p-300, 0x1p300)", 1, "all_within(tag, r, 0.0, 1e308)", "triangle: no range"),
    (F, "all_within(tag, maxima, 0, 0x1p300)", 0, "all_within(tag, maxima, 0, 0x1p1000)", "segment: overflow"),
    (F, "hn::Set(tag, 0x1p-400)", 0, "hn::Set(tag, 0x1p-1000)", "segment: underflow"),
    (F, "hn::Set(tag, 0x1p-400)", 0, "hn::Set(tag, 0.0)", "segment: no lower end"),
    (F, "all_within(tag, maxima, 0, 0x1p100)", 0, "all_within(tag, maxima, 0, 0x1p1000)", "triangle3d: overflow"),
    (F, "hn::Set(tag, 0x1p-602)", 0, "hn::Set(tag, 0x1p-1000)", "triangle3d: underflow"),
    (F, "hn::Set(tag, 0x1p-602)", 0, "hn::Set(tag, 0.0)", "triangle3d: no lower end"),
    (F, "max_x = hn::Max(max_x, x[k])", 0, "max_x = x[k]", "the range of the last axis alone"),
    (F, "min_x = hn::Min(min_x, x[k])", 0, "min_x = x[k]", "the range of the last axis alone"),
    (F, "out[k] = hn::Max(out[k], hn::Abs(vectors[2][k]))", 0, "out[k] = hn::Abs(vectors[2][k])", "extents of the last vector"),
    (F, "out[k] = hn::Max(out[k], max_magnitude(vectors[2][k], vectors[3][k]))", 0, "", "extents of two vectors"),
    (F, "return hn::Max(hn::Abs(x), hn::Abs(y))", 0, "return hn::Max(x, y)", "a sign in the extents"),
    (F, "hn::And(bound.valid, hn::Gt(min_numerator, bound.numerator))", 0, "bound.valid", "numerators are never checked"),
    (F, "hn::Gt(hn::Abs(f.denominator), bound.denominator)", 0, "bound.valid", "the denominator is never checked"),
    (F, "hn::And(bound.valid, hn::Gt(min_numerator, bound.numerator))", 0, "hn::Gt(min_numerator, bound.numerator)", "ranges are never checked"),
    (F, "packed = hn::Xor(packed, hn::And(flip, hn::Set(bits, all)))", 0, "", "the orientation left out"),
    (F, "y * z + x * z + x * y", 0, "y * z + x * z", "a term of P left out"),
    # the middle tier
    (R, "constant(4 * u) * dot", 0, "constant(1 * u) * dot", "the bound for one weight taken for all"),
    (R, "constant(100) * k", 0, "constant(1) * k", "hundredth of the bound on the residual's part"),
    (R, "constant(100) * k", 0, "constant(10) * k", "a tenth of it"),
    (R, "constant(100) * k + constant(50)", 0, "constant(1) * k + constant(0.5)", "a hundredth of both"),
    (R, "constant(100) * k + constant(50)", 0, "constant(0.1) * k + constant(0.05)", "a thousandth of both"),
    (R, "constant(50))", 0, "constant(0))", "the part that does not grow with k left out"),
    (R, "constant(100) * k + constant(50)", 0, "constant(0) * k + constant(0)", "no bound on the residual's part"),
    (R, "constant(4 * 172 * u * u)", 0, "constant(4 * 1 * u * u)", "rounding of sums of remainders"),
    (R, "constant(4 * 172 * u * u)", 0, "constant(4 * 0.1 * u * u)", "a tenth of a rounding"),
    (R, "constant(4 * 172 * u * u)", 0, "constant(4 * 10 * u * u)", "a seventeenth"),
    (R, "constant(4 * 172 * u * u)", 0, "constant(4 * 0.01 * u * u)", "a hundredth of a rounding"),
    (R, "constant(4 * 172 * u * u)", 0, "constant(0.0)", "no bound on the rounding of remainders"),
    (R, "out.error = scale * (from_residual + from_rounding)", 0, "out.error = hn::Zero(tag)", "no bound at all"),
    (R, "hn::Ge(min_extent, constant(0x1p-200))", 0, "hn::Ge(min_extent, constant(0x1p-330))", "underflow"),
    (R, "hn::Ge(min_extent, constant(0x1p-200))", 0, "hn::Ge(min_extent, constant(0.0))", "underflow"),
    (R, "hn::Le(max_size, constant(0x1p900))", 0, "hn::Le(max_size, constant(0x1p1023))", "overflow of the split"),
    (R, "hn::Le(g, constant(0x1p500))", 0, "hn::Le(g, constant(1e308 * 10))", "overflow"),
    (R, "hn::Ge(k, constant(0.125))", 0, "hn::Ge(k, constant(0.0))", "overflow of the denominator"),
    (R, "hn::Le(k, constant(0x1p36))", 0, "hn::Le(k, constant(0x1p200))", "a degenerate cell is not certified to be none"),
    (R, "hn::Le(out.magnitude, constant(0x1p100))", 0, "hn::Le(out.magnitude, constant(0x1p1000))", "large weights"),
    (R, "hn::Le(out.magnitude, constant(0x1p100))", 1, "hn::Le(out.magnitude, constant(0x1p1000))", "large weights, projected"),
    (R, "18 * u * u / (5.5", 0, "1 * u * u / (5.5", "segment: error of the numerator"),
    (R, "18 * u * u / (5.5", 0, "4 * u * u / (5.5", "segment: a quarter of it"),
    (R, "18 * u * u / (5.5", 0, "0.25 * u * u / (5.5", "segment: a quarter of a rounding"),
    (R, "18 * u * u / (5.5", 0, "0 * u * u / (5.5", "segment: none"),
    (R, "44 * u * u / (11.5", 0, "2 * u * u / (11.5", "triangle3d: error of numerators"),
    (R, "44 * u * u / (11.5", 0, "0.5 * u * u / (11.5", "triangle3d: half a rounding"),
    (R, "44 * u * u / (11.5", 0, "10 * u * u / (11.5", "triangle3d: a quarter of it"),
    (R, "44 * u * u / (11.5", 0, "0 * u * u / (11.5", "triangle3d: none"),
    (R, "constant(18 * u * u) * f.denominator.high", 0, "constant(0.0) * f.denominator.high", "segment: error of the denominator"),
    (R, "max_weight * denominator_error", 0, "hn::Zero(tag)", "error of the denominator left out"),
    (R, "constant(1.02)", 0, "constant(0.1)", "a tenth of the bound"),
    (R, "constant(1.02)", 0, "constant(0.03)", "a thirtieth of the bound"),
    (R, "constant(1.02)", 0, "constant(0.3)", "a third of the bound"),
    (R, "constant(26 * u * u) * max_weight", 0, "hn::Zero(tag)", "rounding of the correction"),
    (R, "hn::Le(denominator_error, constant(0x1p-10) * f.denominator.high)", 0,
     "hn::Le(denominator_error, constant(0x1p200) * f.denominator.high)", "a degenerate cell is not certified to be none"),
    (R, "(f.numerator[i].low - w * f.denominator.low)", 0, "f.numerator[i].low", "a correction of the denominator left out"),
    (R, "hn::Set(tag, 1 + 0x1p-40) * r.error", 0, "hn::Set(tag, 0.5) * r.error", "half the bound"),
    (R, "hn::Set(tag, 1 + 0x1p-40) * r.error", 0, "hn::Set(tag, 0x1p-3) * r.error", "an eighth of the bound"),
    (R, "hn::Set(tag, 1 + 0x1p-40) * r.error", 0, "hn::Set(tag, 0x1p-6) * r.error", "a 64th of the bound"),
    (R, "hn::Set(tag, 0x1p-52) * hn::Abs(r.correction[i])", 0, "hn::Zero(tag)", "rounding of y -+ error"),
    (R, "x + (y - error), high", 0, "x + y, high", "one end of the bound only"),
    (R, "high = x + (y + error)", 0, "high = x + y", "one end of the bound only"),
    (R, "certain = hn::And(certain, hn::Eq(low, high));", 0, "", "certain whatever it rounds to"),
    (R, "hn::Set(tag, n) * r.error", 0, "r.error", "one weight's error taken for all of them"),
    (R, "hn::Set(tag, n) * r.error", 0, "hn::Set(tag, n * 0x1p-6) * r.error", "a 64th of the weights' errors"),
    (R, "const V error = max_value * (hn::Set(tag, n) * r.error + hn::Set(tag, 0x1p-98) * r.magnitude)", 0,
     "const V error = max_value * hn::Set(tag, 0x1p-6) * (hn::Set(tag, n) * r.error + hn::Set(tag, 0x1p-98) * r.magnitude)", "a 64th of a value's bound"),
    (R, "const V error = max_value * (hn::Set(tag, n) * r.error + hn::Set(tag, 0x1p-98) * r.magnitude)", 0,
     "const V error = max_value * hn::Set(tag, 0x1p-9) * (hn::Set(tag, n) * r.error + hn::Set(tag, 0x1p-98) * r.magnitude)", "a 512th of a value's bound"),
    (R, "hn::Set(tag, 0x1p-98)", 0, "hn::Set(tag, 0x1p-106)", "a 256th of the rounding of a value"),
    (R, "hn::Set(tag, 0x1p-98)", 0, "hn::Zero(tag)", "no rounding of a value"),
    (R, "certain = hn::And(certain, in_range);", 0, "", "nodal values of any range"),
    (R, "hn::Set(tag, 0x1p-800)", 0, "hn::Set(tag, 0x1p-1074)", "nodal values: underflow"),
    (R, "hn::Set(tag, 0x1p900)", 0, "hn::Set(tag, 0x1p1023)", "nodal values: overflow"),
    (R, "error, certain) +\n           hn::Zero(tag)", 0, "error, certain)", "a zero value may be negative"),
    (R, "- residual_sum * c.v[last][k]", 0, "", "what the weights' sum lacks left out"),
    (R, "final_weight.low - others.sum_rest", 0, "final_weight.low", "remainders of the sum left out"),
    (R, "sum_rest = sum_rest + t.low;", 1, "", "remainders of sums left out"),
    (R, "product_rest = product_rest - p.low;", 0, "", "remainders of products left out"),
    # error-free transforms
    (E, "0x1p27 + 1", 0, "0x1p28 + 1", "split one bit too low"),
    (E, "0x1p27 + 1", 0, "0x1p27", "split by a power of two"),
    (E, "hn::MulSub(x, y, p)", 0, "hn::Zero(hn::DFromV<V>())", "no remainder of a product"),
    (E, " + a.low * b.low", 0, "", "the low parts' product left out"),
    # rounding
    (Q, "(inexact || (mantissa & 1) != 0)", 0, "(mantissa & 1) != 0", "sticky bit left out"),
    (Q, "(inexact || (mantissa & 1) != 0)", 0, "inexact", "ties down"),
    (Q, "(inexact || (mantissa & 1) != 0)", 0, "true", "ties up"),
    (Q, "rest > half ||", 0, "", "only ties rounded up"),
    (Q, "top > 1023", 0, "top > 1022", "overflow one binade early"),
    (Q, "top > 1023", 0, "top > 1024", "overflow one binade late"),
    (Q, "std::max(top - 52, -1074)", 0, "std::max(top - 52, -1073)", "subnormals a bit short"),
    (Q, "std::max(top - 52, -1074)", 0, "std::max(top - 52, -1075)", "subnormals a bit long"),
    (Q, "std::max(top - 52, -1074)", 0, "top - 52", "no subnormals"),
    (Q, "std::max(top - 52, -1074)", 0, "std::max(top - 51, -1074)", "52 bits"),
    (Q, "dropped > 64", 0, "dropped > 63", "the half of the smallest subnormal lost"),
    (Q, "dropped > 64", 0, "dropped > 65", "below the half of the smallest subnormal"),
    (Q, "dropped == 64 ? 0 : q >> dropped", 0, "q >> (dropped & 63)", "a shift by the width"),
    (Q, "--q;", 0, "", "the digit is not corrected"),
    (Q, "while (borrow != 0)", 0, "if (borrow != 0)", "corrected once at most"),
    (Q, "while (borrow != 0)", 0, "while (false)", "never corrected"),
    (Q, "const bool inexact = std::any_of(rest, rest + k,", 0, "const bool inexact = std::any_of(rest, rest + 1,", "one limb of the rest"),
    (Q, "std::any_of(rest, rest + k,", 0, "std::any_of(rest + 1, rest + k,", "the lowest limb of the rest left out"),
    (Q, "exponent + n_bits - d_bits - 63", 0, "exponent + n_bits - d_bits - 62", "exponent"),
    (Q, "rest[k] = subtract_with_borrow(rest[k], carry, borrow);", 0, "", "the top limb is not subtracted from"),
    (Q, "if (n_bits == 0) return 0.0;", 0, "", "no zero"),
    (Q, "below >> (64 - part)", 0, "0", "bits across limbs left out"),
    (Q, "static_cast<UInt128>(q) * divisor[i] + carry", 0, "static_cast<UInt128>(q) * divisor[i]", "carry left out"),
    # integers
    (I, "limbs_[whole + 1] = part == 0 ? 0 : mantissa >> (64 - part)", 0, "limbs_[whole + 1] = 0", "bits across limbs"),
    (I, "+ r.limbs_[i + j] + carry", 0, "+ r.limbs_[i + j]", "carry of a product left out"),
    (I, "r.limbs_[i + b.size_] = carry;", 0, "", "last carry of a row left out"),
    (I, "if (carry != 0) r.limbs_[r.size_++] = 1;", 0, "", "last carry of a sum left out"),
    (I, "r.negative_ = x.negative_ != y.negative_;", 0, "r.negative_ = false;", "sign of a product"),
    (I, "r.negative_ = order > 0 ? x.negative_ : y_negative;", 0, "r.negative_ = x.negative_;", "sign of a difference"),
    (I, "r.negative_ = x.size_ == 0 ? y_negative : x.negative_;", 0, "r.negative_ = x.negative_;", "sign of 0 + y"),
    (I, "if (order == 0) return {};", 0, "", "zero has limbs"),
    (I, "sum(x, y, !y.negative_)", 0, "sum(x, y, y.negative_)", "minus is plus"),
    (I, "if (a.limbs_[i] == 0) continue;", 0, "", "speed alone"),
    ("fixed_integer.hpp", "y.limbs[i] & x_mask", 0, "y.limbs[i] & 0", "negative factor"),
    ("fixed_integer.hpp", "x.limbs[i] & y_mask", 0, "x.limbs[i] & 0", "negative factor"),
    ("fixed_integer.hpp", "    borrow = 0;\n", 0, "", "borrow carried over to the second factor"),
    ("fixed_integer.hpp", "+ r.limbs[i + j] + carry", 0, "+ r.limbs[i + j]", "carry of a product left out"),
    ("fixed_integer.hpp", "r.limbs[i + M] = carry;", 0, "", "last carry of a row left out"),
    (S, "bits <= 64 - room) return f", 0, "bits <= 64 - (room - 1)) return f", "one bit less room in one limb"),
    (S, "bits <= 64 - room) return f", 0, "bits <= 64 - (room - 2)) return f", "two bits less room in one limb"),
    (S, "bits <= 64 - room) return f", 0, "bits <= 64) return f", "no room in one limb"),
    (S, "bits <= 128 - room", 0, "bits <= 128 - (room - 1)", "one bit less room in two limbs"),
    (S, "bits <= 128 - room", 0, "bits <= 128", "no room in two limbs"),
    (X, "unit.bits() <= 64 - 3", 0, "unit.bits() <= 64", "no room for nodal values"),
    (X, "unit.bits() <= 64 - 3", 0, "true", "nodal values of any spread in one limb"),
    (S, "bits = std::max(bits, u.bits())", 0, "bits = u.bits()", "the width of the last axis alone"),
    (S, "std::max(biased, 1) - 1", 0, "biased - 1", "subnormals a binade lower"),
    (S, "biased == 0 ? 0 : std::uint64_t{1} << 52", 0, "std::uint64_t{1} << 52", "a hidden bit for subnormals"),
    (S, "m == 0 ? ScaledDouble::none : ", 0, "", "zeros count for the unit"),
    (S, "x.mantissa == 0 ? 0 : above", 0, "above", "zeros count for the width"),
    (S, "top = std::max(top, u.top);", 0, "", "axes are not joined: the largest"),
    (S, "exponent = std::min(exponent, u.exponent);", 0, "", "axes are not joined: the least"),
    (S, "x.exponent + static_cast<int>(std::bit_width(x.mantissa))", 0, "x.exponent", "width of a mantissa left out"),
    (X, "if (common) {", 0, "if (false) {", "a unit for each axis where one is due"),
    (X, "above = x[i] & f_mask;", 0, "above = 0;", "negative nodal value"),
    (X, "high - (f & x_mask)", 0, "high", "negative numerator"),
    (X, "sign(i) < 0, magnitude", 0, "sign_of(i) < 0, magnitude", "sign of the denominator left out"),
    (X, "sign_of(sum, limbs_ + 1) != orientation()", 0, "sign_of(sum, limbs_ + 1) < 0", "sign of the denominator left out"),
    (X, "sum.sign() != orientation()", 0, "sum.sign() < 0", "sign of the denominator left out, wide"),
    (X, "unit_x.exponent + unit_y.exponent", 0, "unit_x.exponent", "unit of the second factor"),
    # single predicates
    ("predicates.cpp", "8.5 * epsilon", 0, "4 * epsilon", "half the bound of orient2d"),
    ("predicates.cpp", "8.5 * epsilon", 0, "1.5 * epsilon", "an error of 4 e is known"),
    ("predicates.cpp", "8.5 * epsilon", 0, "0 * epsilon", "no bound"),
    ("predicates.cpp", "49 * epsilon", 0, "24 * epsilon", "half the bound of orient3d"),
    ("predicates.cpp", "49 * epsilon", 0, "5 * epsilon", "an error of 9 e is known"),
    ("predicates.cpp", "49 * epsilon", 0, "0 * epsilon", "no bound"),
    ("predicates.cpp", "epsilon = 0x1p-52", 0, "epsilon = 0x1p-55", "an eighth of every bound"),
    ("predicates.cpp", "extent >= 0x1p-300", 0, "extent >= 0x1p-1000", "underflow"),
    ("predicates.cpp", "extent <= 0x1p300", 0, "extent <= 0x1p1000", "overflow"),
    ("predicates.cpp", "in_range(x) && in_range(y) && std::fabs(det) > 8.5", 0, "std::fabs(det) > 8.5", "orient2d: no range"),
    ("predicates.cpp", "in_range(x) && in_range(y) && in_range(z) && ", 0, "", "orient3d: no range"),
    ("weight_signs.cpp", "if (w.degenerate()) return WeightSigns::degenerate_simplex();", 0, "", "degenerate simplices"),
    ("weight_signs.cpp", "bits |= 1U << (4 + i)", 0, "bits |= 1U << (3 + i)", "zero bit of another weight"),
    ("weight_signs.cpp", "w.orientation() < 0 ? 1U << 8 : 0", 0, "0", "orientation bit left out"),
    ("blocks.hpp", "counts.degenerate += found.degenerate ? 1 : 0;", 0, "", "degenerate cases uncounted"),
    # weights, blocks, lanes, inverse
    ("weights.cpp", "const ExactEnvironment environment;", 0, "", "batch of weights in the caller's environment"),
    ("weights.cpp", "const ExactEnvironment environment;", 2, "", "single weights in the caller's environment"),
    ("weights.cpp", "const ExactEnvironment environment;", 3, "", "single value in the caller's environment"),
    ("weights.cpp", "const ExactEnvironment environment;", 1, "", "values in the caller's environment"),
    ("weights.cpp", "w.degenerate() ? nan : w.weight(i)", 0, "w.weight(i)", "weights of degenerate simplices"),
    ("weights.cpp", "const bool usable = all_finite(f, n);", 0, "const bool usable = true;", "nodal values that are not finite"),
    ("weights.cpp", "const bool usable = all_finite(f, n);", 0, "const bool usable = all_finite(f, n - 1);", "the last nodal value"),
    ("weights.cpp", "found.finite_values = found.finite_values && usable;", 0, "found.finite_values = usable;", "the last component alone counts"),
    ("weights.cpp", "values_.at[i] + components_ * first", 0, "values_.at[i] + first", "components of later blocks"),
    ("input_checks.hpp", "all_finite(point, 1) ? all_finite(point, 2) ? 2 : 1 : 0", 0, "0", "which coordinate of the point"),
    ("input_checks.hpp", "(point == nullptr || all_finite(point, space_dimension(s)))", 0, "true",
     "points that are not finite"),
    ("lane_loop-inl.hpp", "run(hn::CappedTag<double, 1>());", 0, "", "the rest of a batch"),
    ("lane_loop-inl.hpp", "numbers[count] = static_cast<std::uint32_t>(at + i);", 0, "numbers[count] = static_cast<std::uint32_t>(i);", "numbers within the vector"),
    ("lane_loop-inl.hpp", "(bits[0] >> i & 1) == 0 ? 1 : 0", 0, "(bits[0] >> i & 1) == 0 && i + 1 < used ? 1 : 0", "the last lane's indecision"),
    ("lanes.cpp", "out + at * stride + static_cast<std::size_t>(c), stride", 0, "out + at * stride, stride", "all components to the first"),
    ("lanes.cpp", "values[n * c + i] + at", 0, "values[i] + at", "all components from the first"),
    ("inverse.cpp", "if (w.degenerate()) {", 0, "if (false) {", "undetermined values"),
    ("inverse.cpp", "Parameter{w.weight(1), false}", 0, "Parameter{w.weight(0), false}", "the weight of a"),
    ("inverse.cpp", "if (!std::isfinite(numbers[i]))", 0, "if (false)", "arguments that are not finite"),
    ("inverse.cpp", "static_cast<int>(n));", 0, "static_cast<int>(n) - 1);", "the last vertex left out"),
]

COMPARISONS = [(" > ", " >= "), (" < ", " <= "), (" >= ", " > "), (" <= ", " < "), (" == ", " != "), (" != ", " == "),
               ("hn::Gt(", "hn::Ge("), ("hn::Ge(", "hn::Gt("), ("hn::Le(", "hn::Lt("), ("hn::Eq(", "hn::Ne(")]
SIGNS = [(" + ", " - "), (" - ", " + ")]
COMPARED = [F, R, Q, X, S, I, "predicates.cpp", "weight_signs.cpp", "weights.cpp", "blocks.hpp", "input_checks.hpp", "inverse.cpp",
            "lane_loop-inl.hpp", "lanes.cpp"]
SUMMED = ["numerators-inl.hpp", E, "double_double-inl.hpp", R, F]


def code_lines(text):
    """(offset, line) of lines of code, without what is to the right of //."""
    offset = 0
    for line in text.splitlines(keepends=True):
        code = line.split("//")[0]
        if code.strip() and not code.lstrip().startswith(("#", "template", "static_assert")):
            yield offset, code
        offset += len(line)


class Mutant:
    def __init__(self, file, position, old, new, why, text):
        self.file, self.position, self.old, self.new, self.why = file, position, old, new, why
        self.status, self.detail, self.tiers, self.target = "", "", "", "fma"
        self.listed = why not in ("comparison", "sign")
        self.line = text.count("\n", 0, position) + 1 if position >= 0 else 0
        start = text.rfind("\n", 0, position) + 1
        self.source = text[start:text.find("\n", position)].strip() if position >= 0 else ""
        self.column, self.repeat = position - start, text.count(self.source, 0, max(start, 0))


def nth(text, part, occurrence):
    """Where that occurrence of a part begins, -1 if there is none."""
    position = -1
    for _ in range(occurrence + 1):
        position = text.find(part, position + 1)
        if position < 0:
            break
    return position


def spread(items):
    """The same items so ordered that however many are taken from the front, they lie about evenly."""
    turn = (5 ** 0.5 - 1) / 2
    return [items[i] for i in sorted(range(len(items)), key=lambda i: i * turn % 1)]


def all_mutants(core):
    """The listed mutants, then the generated ones, spread; and the texts of the sources."""
    files = {m[0] for m in EXPLICIT} | set(COMPARED) | set(SUMMED)
    texts = {file: (core / file).read_text() for file in files}
    listed = [Mutant(file, nth(texts[file], old, occurrence), old, new, why, texts[file])
              for file, old, occurrence, new, why in EXPLICIT]
    generated = []
    for files, changes, why in ((COMPARED, COMPARISONS, "comparison"), (SUMMED, SIGNS, "sign")):
        for file in files:
            for offset, code in code_lines(texts[file]):
                if "for (" in code or "constexpr bool" in code:
                    continue  # a loop without its end tells nothing
                for old, new in changes:
                    at = code.find(old)
                    while at >= 0:
                        generated.append(Mutant(file, offset + at, old, new, why, texts[file]))
                        at = code.find(old, at + 1)
    listed.sort(key=lambda m: m.file != R)  # its survivors are the ones to be looked at first
    mutants = listed + spread(generated)
    for m in mutants:  # Dekker's product is compiled where there is no fused one
        behind = m.file == E and m.position > texts[E].find("HWY_INLINE TwoTerms<V> split(")
        if behind and "MulSub" not in m.source or m.old.startswith("0x1p27"):
            m.target = "split"
    return mutants, texts
