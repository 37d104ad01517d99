#include "app/studio/messages/message.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <new>
#include <system_error>

#include "model/base/invalid_input.hpp"
#include "targets/document/document.hpp"
#include "targets/document/json_depth.hpp"

namespace kinetix::app::studio {
namespace {

constexpr double farthest_mm = 1e6;           // a point a kilometre away is a slip of the mouse
constexpr std::size_t most_entries = 100000;  // per list, 1: more than any sheet has hinges

InvalidInput wrong(const char* key, const std::string& allowed) {
  return InvalidInput(fmt::format("{}: must be {}", key, allowed));
}

double number_of(const nlohmann::json& value, const char* key, double least, double most) {
  const double number = value.is_number() ? value.get<double>() : std::nan("");
  if (number >= least && number <= most) return number;
  throw wrong(key, fmt::format("a number from {:g} to {:g}", least, most));
}

int integer_of(const nlohmann::json& value, const char* key, int least, int most) {
  const double number = value.is_number() ? value.get<double>() : std::nan("");
  if (!(number >= least && number <= most && number == std::floor(number)))
    throw wrong(key, fmt::format("a whole number from {} to {}", least, most));
  return static_cast<int>(number);
}

std::string text_of(const nlohmann::json& value, const char* key) {
  if (!value.is_string()) throw wrong(key, "a text");
  return value.get<std::string>();
}

const nlohmann::json& list_of(const nlohmann::json& value, const char* key) {
  if (!value.is_array() || value.size() > most_entries) throw wrong(key, "a list");
  return value;
}

nlohmann::json parsed(std::string_view text) {
  if (targets::find_too_deep(text))
    throw InvalidInput("the command is nested too deep; send at most " +
                       std::to_string(targets::max_document_depth) + " lists and maps in one another");
  return nlohmann::json::parse(text.begin(), text.end(), nullptr, false);
}

}  // namespace

Message::Message(std::string_view text) : body_(parsed(text)) {
  if (body_.is_discarded() || !body_.is_object()) throw InvalidInput("a command is a JSON object");
  type_ = this->text("type");
  if (has("id")) id_ = number("id", 1, 1e15);
}

const nlohmann::json& Message::at(const char* key, const char* what) const {
  const auto found = body_.find(key);
  if (found == body_.end()) throw InvalidInput(fmt::format("{}: missing; it is {}", key, what));
  return *found;
}

double Message::number(const char* key, double least, double most) const {
  return number_of(at(key, "a number"), key, least, most);
}

int Message::integer(const char* key, int least, int most) const {
  return integer_of(at(key, "a whole number"), key, least, most);
}

bool Message::boolean(const char* key) const {
  const nlohmann::json& value = at(key, "true or false");
  if (!value.is_boolean()) throw wrong(key, "true or false");
  return value.get<bool>();
}

std::string Message::text(const char* key) const { return text_of(at(key, "a text"), key); }

Eigen::Vector3d Message::point(const char* key) const {
  const nlohmann::json& value = at(key, "[x, y, z] in mm");
  if (!value.is_array() || value.size() != 3) throw wrong(key, "[x, y, z] in mm");
  Eigen::Vector3d point;
  for (int k = 0; k < 3; ++k) point[k] = number_of(value[k], key, -farthest_mm, farthest_mm);
  return point;
}

std::vector<double> Message::numbers(const char* key, double least, double most) const {
  std::vector<double> all;
  for (const auto& value : list_of(at(key, "a list of numbers"), key))
    all.push_back(number_of(value, key, least, most));
  return all;
}

std::vector<int> Message::integers(const char* key, int least, int most) const {
  std::vector<int> all;
  for (const auto& value : list_of(at(key, "a list of whole numbers"), key))
    all.push_back(integer_of(value, key, least, most));
  return all;
}

std::vector<std::string> Message::texts(const char* key) const {
  std::vector<std::string> all;
  for (const auto& value : list_of(at(key, "a list of texts"), key)) all.push_back(text_of(value, key));
  return all;
}

std::vector<std::pair<std::string, std::string>> Message::named_texts(const char* key) const {
  const nlohmann::json& value = at(key, "a map of texts");
  if (!value.is_object()) throw wrong(key, "a map of texts");
  std::vector<std::pair<std::string, std::string>> all;
  for (const auto& [name, entry] : value.items()) all.emplace_back(name, text_of(entry, key));
  return all;
}

std::string failure_message(const std::exception& error) {
  if (dynamic_cast<const InvalidInput*>(&error)) return error.what();
  if (dynamic_cast<const std::bad_alloc*>(&error))
    return "There is not enough memory for this. Take a smaller sheet, or close other programs.";
  if (const auto* file = dynamic_cast<const std::filesystem::filesystem_error*>(&error)) {
    const std::string path =
        file->path1().empty() ? "the folder that the studio was started in" : file->path1().string();
    return path + ": " + file->code().message() + ". Check that it is there and can be written.";
  }
  const auto* system = dynamic_cast<const std::system_error*>(&error);
  if (system && system->code() == std::errc::resource_unavailable_try_again)
    return "No further thread or process can be started. Close other programs.";
  return std::string("internal error: ") + error.what();
}

std::string plain_number(double value, int digits) {
  constexpr double least = 0.01,
                   most = 99'999.5;  // larger numbers are easier to read with an exponent
  const double size = std::abs(value);
  if (value != 0 && !(size >= least && size < most)) return fmt::format("{:.{}g}", value, digits);
  const int before = value == 0 ? digits : static_cast<int>(std::floor(std::log10(size))) + 1;
  return fmt::format("{:.{}f}", value, std::max(0, digits - before));
}

}  // namespace kinetix::app::studio
