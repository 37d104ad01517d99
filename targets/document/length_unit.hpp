#pragma once

#include "targets/document/section.hpp"

namespace kinetix::targets {

/// Units of lengths in files, with the mm in each.
inline constexpr Word<double> length_units[] = {
    {"mm", 1}, {"cm", 10}, {"dm", 100}, {"m", 1000}, {"in", 25.4}};

/// Returns the type of a key for the unit of a file: a word of length_units, or the mm in one unit of the file.
ValueType unit_type();

/// Reads the mm in a unit under a key of unit_type(); empty if the key is not given.
std::optional<double> read_unit(const Section& section, std::string_view key);

/// Finds the mm in a unit by its word.
std::optional<double> find_unit(std::string_view word);

/// Advises on the key `units` for a thing of `size` file units that should have about `usual_mm`: "Give `units: cm` for
/// 230 mm", or a number of mm if no unit fits.
/// @param lower, upper allowed sizes, mm
std::string advise_unit(double size, double usual_mm, double lower, double upper);

}  // namespace kinetix::targets
