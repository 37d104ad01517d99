#pragma once

#include <string>

namespace kinetix::app::studio {

/// A number for people: to so many significant digits, without an exponent from 0.01 to 99 999.
std::string plain_number(double value, int digits = 3);

}  // namespace kinetix::app::studio
