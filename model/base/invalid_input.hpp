#pragma once

#include <stdexcept>
#include <string>

namespace kinetix {

/// Position in an input file.
struct Place {
  std::string file;      ///< as the user named it; empty when there is no file
  int line = 0;          ///< from 1; 0 = not known
  int column = 0;        ///< from 1; 0 = not known
  std::string key = {};  ///< dotted path, e.g. "variables.beta.range_deg"; empty when not inside a document
};

/// Formats a number as messages write it.
std::string number_text(double number);

/// The only exception type for bad input. Its message reads
/// `file:line:column: key.path: what is wrong, what is allowed`, without the parts that are not known. The program maps it to exit code 2.
class InvalidInput : public std::runtime_error {
 public:
  explicit InvalidInput(const std::string& fault_text, Place place = {});

  const Place& place() const { return place_; }
  /// The message without the place.
  const std::string& reason() const { return reason_; }

 private:
  Place place_;
  std::string reason_;
};

/// Checks an input field. NaN must fail, so write `fine` as a comparison that is false for NaN.
/// @throws InvalidInput "FIELD is VALUE, must be ALLOWED" unless `fine`
void require(const std::string& field, double value, bool fine, const std::string& allowed);

}  // namespace kinetix
