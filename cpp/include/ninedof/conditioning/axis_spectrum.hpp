#pragma once
/// The closed form of symmetric.hpp for numbers of any size within the range of lengths.

#include "ninedof/conditioning/symmetric.hpp"

namespace ninedof {

/// axis_spectrum in a unit, a power of two, in which no product of four lengths overflows.
AxisSpectrum<double> axis_spectrum_of_any_size(const AxisDesign<double>& d, double characteristic_length);

}  // namespace ninedof
