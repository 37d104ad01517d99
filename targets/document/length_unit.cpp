#include "targets/document/length_unit.hpp"

#include <cctype>
#include <cmath>

#include "targets/document/wording.hpp"

namespace kinetix::targets {
namespace {

const Bounds unit_bounds = from_to(1e-9, 1e9, "mm");  // from an atom to a thousand kilometres

}  // namespace

ValueType unit_type() { return value::either({value::choice(length_units), value::number(unit_bounds)}); }

std::optional<double> find_unit(std::string_view word) {
  for (const auto& [name, mm] : length_units)
    if (name == word) return mm;
  return std::nullopt;
}

std::optional<double> read_unit(const Section& section, std::string_view key) {
  const auto node = section.optional(key);
  if (!node) return std::nullopt;
  const std::string text = node->text("a unit such as mm, or the mm in one unit of the file");
  if (const auto mm = find_unit(text)) return mm;
  if (!text.empty() && std::isalpha(static_cast<unsigned char>(text[0])))
    throw node->error(in_ticks(text) + " is not a known unit; allowed: " + joined(names_of(length_units)) +
                      ". Give one of them, or the mm in one unit of the file as a number");
  return node->number(unit_bounds);
}

std::string advise_unit(double size, double usual_mm, double lower, double upper) {
  const auto strangeness = [&](double mm) { return std::abs(std::log(size * mm / usual_mm)); };
  const auto* best = std::min_element(std::begin(length_units), std::end(length_units),
                                      [&](const Word<double>& a, const Word<double>& b) {
                                        return strangeness(a.second) < strangeness(b.second);
                                      });
  const double best_mm = size * best->second;
  if (best_mm >= lower && best_mm <= upper)
    return "Give `units: " + std::string(best->first) + "` for " + number_text(best_mm) + " mm";
  const double unit = usual_mm / size, digit = std::pow(10, std::floor(std::log10(unit)));
  const double factor = digit * std::round(unit / digit);
  return "Give `units: " + shortest_text(factor) + "`, the mm in one unit of the file, for " +
         number_text(size * factor) + " mm";
}

}  // namespace kinetix::targets
