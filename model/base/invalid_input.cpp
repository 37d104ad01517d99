#include "model/base/invalid_input.hpp"

#include <sstream>
#include <utility>

namespace kinetix {
namespace {

std::string message(const Place& place, const std::string& reason) {
  std::string text = place.file;
  if (place.line > 0) text.append(":").append(std::to_string(place.line));
  if (place.line > 0 && place.column > 0) text.append(":").append(std::to_string(place.column));
  if (!text.empty()) text += ": ";
  if (!place.key.empty()) text += place.key + ": ";
  return text + reason;
}

}  // namespace

std::string number_text(double number) {
  std::ostringstream out;
  out << number;
  return out.str();
}

InvalidInput::InvalidInput(const std::string& fault_text, Place place)
    : std::runtime_error(message(place, fault_text)), place_(std::move(place)), reason_(fault_text) {}

void require(const std::string& field, double value, bool fine, const std::string& allowed) {
  if (!fine) throw InvalidInput(field + " is " + number_text(value) + ", must be " + allowed);
}

}  // namespace kinetix
