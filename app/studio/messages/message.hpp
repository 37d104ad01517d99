#pragma once

#include <exception>
#include <nlohmann/json.hpp>

#include "app/studio/play/player.hpp"
#include "app/studio/play/shape.hpp"

namespace kinetix::app::studio {

inline constexpr double steepest_deg = 89;  ///< largest |theta| of a command, deg, as for --theta-deg

/// Command of the page, read strictly. Every getter throws InvalidInput that names the key and the allowed
/// values.
class Message {
 public:
  /// @throws InvalidInput for text that is not a JSON object with a `type`, or whose `id` is not a positive
  /// number
  explicit Message(std::string_view text);

  const std::string& type() const { return type_; }
  double id() const { return id_; }  ///< 0: none

  bool has(const char* key) const { return body_.contains(key); }
  double number(const char* key, double least, double most) const;
  int integer(const char* key, int least, int most) const;
  bool boolean(const char* key) const;
  std::string text(const char* key) const;
  Eigen::Vector3d point(const char* key) const;  ///< mm
  std::vector<int> integers(const char* key, int least, int most) const;
  std::vector<double> numbers(const char* key, double least, double most) const;
  std::vector<std::string> texts(const char* key) const;
  /// Reads a map from names to texts.
  std::vector<std::pair<std::string, std::string>> named_texts(const char* key) const;

 private:
  const nlohmann::json& at(const char* key, const char* what) const;

  nlohmann::json body_;
  std::string type_;
  double id_ = 0;
};

/// Describes for people why a command of the page failed.
std::string failure_message(const std::exception& error);

/// Formats a number with `digits` significant digits; without an exponent from 0.01 to 99 999.
std::string plain_number(double value, int digits = 3);

/// Returns the message `hello` of studio-protocol.md.
nlohmann::ordered_json hello_message(const std::string& name);
/// Returns the message `design` without what only the session knows: revision, undo, redo, unsaved.
nlohmann::ordered_json design_message(const Design& design, const Moving& moving);
/// Returns the message `state` without whether a search is running.
nlohmann::ordered_json state_message(const Player& player);
/// Returns the message `error`.
/// @param id id of the command that it answers; 0: none   @param about type of the command that failed;
/// empty: none
nlohmann::ordered_json error_message(const std::string& what, double id, const std::string& about);
/// Returns the message `progress` without the time left. @param done 0 to 1; negative: not known
nlohmann::ordered_json progress_message(const char* job, const std::string& stage, double done,
                                        const std::string& so_far);

/// Returns the message `meshes`: the surfaces of bodies and soft parts at rest.
nlohmann::ordered_json meshes_message(const model::Assembly& assembly);
/// Returns the message `design` of a design of bodies, without what only the session knows. @pre
/// moving.bodies
nlohmann::ordered_json bodies_message(const Design& design, const Moving& moving);

}  // namespace kinetix::app::studio
