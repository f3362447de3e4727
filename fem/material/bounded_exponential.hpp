#pragma once

namespace articular::fem {

/// exp(x) for stresses that grow exponentially. Where x passes 100 it goes on as its quadratic,
/// exp(100) (1 + d + d²/2) with d = x − 100, without a jump in value, slope or curvature: far
/// outside of what tissue bears, but a trial step of a solver gets numbers and not infinity.
namespace bounded_exponential {

double minus_one(double x);  // of the exponential itself, exact for small x
double slope(double x);
double curvature(double x);

}  // namespace bounded_exponential
}  // namespace articular::fem
