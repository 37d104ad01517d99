#pragma once

#include "app/goals/registry.hpp"
#include "app/pipeline/closed_form.hpp"
#include "tests/fuzz/input_folder.hpp"

namespace kinetix::fuzz {

/// Reads a target and its forecast, as `check` does.
inline void check_target(const targets::Node& root) {
  if (app::read_target(root).goal->forecast().search_s < 0) fail("a search that takes less than no time");
}

/// Reads a design and its forecast, as `check` does.
inline void check_design(const targets::Node& root) { forecast_design(app::read_design(root)); }

/// Returns a document in the folder of inputs. Its text may name an input.
inline targets::Node document_of(const std::string& text) {
  return targets::parse_document("kinetix: 1\n" + text + "\n", input_folder().path("document.yaml"));
}

}  // namespace kinetix::fuzz
