// SPDX-License-Identifier: GPL-3.0-or-later
// Elementary functions that return the double nearest to the true value, and therefore the same result on every
// processor.
#pragma once

namespace crackle::correctly_rounded {

/// sin(x). @param x rad
double sin(double x);
/// cos(x). @param x rad
double cos(double x);
/// tan(x). @param x rad
double tan(double x);
/// Arcsine of x, rad, in [-π/2, π/2].
double asin(double x);
/// Arccosine of x, rad, in [0, π].
double acos(double x);
/// Direction of the vector (x, y), rad, in [-π, π].
double atan2(double y, double x);
/// e to the power of x.
double exp(double x);
/// e to the power of x, minus 1.
double expm1(double x);
/// Natural logarithm.
double log(double x);
/// Natural logarithm of 1 + x.
double log1p(double x);
/// x to the power of y.
double pow(double x, double y);
/// Complementary error function.
double erfc(double x);
/// Gamma function.
double tgamma(double x);
/// Logarithm of the absolute value of the gamma function.
double lgamma(double x);

/// Normal distribution function Φ(z) = ½ erfc(-z/√2), evaluated after the argument of erfc has been rounded to a
/// double.
double normal_share_below(double z);
/// Normal quantile: the z with Φ(z) = ½ erfc(-z/√2) = p, 0 < p < 1.
double normal_quantile(double p);

}  // namespace crackle::correctly_rounded
