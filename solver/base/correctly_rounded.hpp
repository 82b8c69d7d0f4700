// SPDX-License-Identifier: GPL-3.0-or-later
// Elementary functions that give the double nearest to the true value, so the same one on every processor.
//
// A library of mathematics rounds the last digit now up, now down, and takes other instructions, with other last
// digits, where a processor has fused multiply-adds. From one digit on a specimen that breaks is another one. Here the
// result in long double decides wherever it lies far enough from the middle between two doubles (Ziv 1991), else MPFR.
// All that ends in a result goes through here; pictures and benchmarks need not (tools/check_style looks for it).
// Tested by tests/solver/base/correctly_rounded_test.cpp.
#pragma once

namespace crackle::correctly_rounded {

double sin(double x);
double cos(double x);
double tan(double x);
double asin(double x);
double acos(double x);
double atan2(double y, double x);
double exp(double x);
double expm1(double x);
double log(double x);
double log1p(double x);
double pow(double x, double y);
double erfc(double x);
double tgamma(double x);
double lgamma(double x);

/// Φ(z) = ½ erfc(-z/√2), of the rounded argument.
double normal_share_below(double z);
/// z with Φ(z) = ½ erfc(-z/√2) = p, 0 < p < 1.
double normal_quantile(double p);

}  // namespace crackle::correctly_rounded
