#pragma once

#include <nlohmann/json_fwd.hpp>

namespace kinetix::app {

/// Factors whose effect on a response its page plots.
inline constexpr int plotted_factors = 6;  // two rows of three

/// A sweep as its page takes it: numbers to five digits, and of factors that no response plots neither levels nor
/// places of dots. Those with the largest effect are plotted (`plotted`, in each response).
nlohmann::ordered_json light_sweep(nlohmann::ordered_json sweep);

}  // namespace kinetix::app
