#pragma once

#include <string>

#include "targets/document/keys.hpp"

namespace kinetix::app {

/// What a value may be, with its range and unit; Markdown.
std::string type_text(const targets::ValueType& type);

/// What holds where the key is not given, or when it must be; Markdown.
std::string default_text(const targets::Key& key, const targets::Alternatives& ways);

/// Meaning, unit and rule of the default without marks, for an editor's hint.
std::string plain_text(const targets::Key& key);

/// The anchor that a heading gets, as GitHub makes it.
std::string anchor(const std::string& heading);

}  // namespace kinetix::app
