#pragma once

#include <nlohmann/json_fwd.hpp>

namespace kinetix::app {

/// A result as a page takes it, a third of its size: numbers to six digits, poses as `rows` of seven numbers (x, y, z in
/// mm to 0.0001, then the quaternion w, x, y, z to 1e-6), and of the frames between flat and the fold none where the page
/// computes them (`has_scene`, and an exact family), else as many as fit into 60 kB; what no page reads is left out.
nlohmann::ordered_json light_result(nlohmann::ordered_json result, bool has_scene);

/// Without ".0" where it is whole: a script reads the same number.
nlohmann::ordered_json short_number(double x);

/// Every number of a document that is no integer, to so many significant digits; what is less than 1e-15 becomes 0.
void round_numbers(nlohmann::ordered_json& value, int digits);

/// Factors whose effect on a response its page plots.
inline constexpr int plotted_factors = 6;  // two rows of three

/// A sweep as its page takes it: numbers to five digits, and of factors that no response plots neither levels nor
/// places of dots. Those with the largest effect are plotted (`plotted`, in each response).
nlohmann::ordered_json light_sweep(nlohmann::ordered_json sweep);

}  // namespace kinetix::app
