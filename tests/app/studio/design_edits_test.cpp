#include "app/studio/session/design_edits.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/files/design_file.hpp"
#include "app/studio/messages/templates.hpp"
#include "targets/document/document.hpp"
#include "tests/support/bad_input.hpp"

namespace kinetix::testing {
namespace {

using namespace app::studio;

Message hinge_at_offset(const std::string& mm) {
  return Message(R"({"type": "hinge", "index": 3, "offset_mm": )" + mm + "}");
}

/// The studio must be able to read the designs that it saves.
TEST(DesignEdits, PutMadeHingesOffTheirWall) {
  const Message films(R"({"type": "made", "kind": "film", "material": "pp"})");
  const app::Design panel = template_design("panel");
  const app::Design made = with_manufactured_hinges(panel, films);
  const app::Design far = with_hinges(made, hinge_at_offset("4"));
  const targets::Node text = targets::parse_document(design_text(far), "design.yaml");
  EXPECT_NEAR(app::read_design(text).structure.hinge(3).offset * far.structure.size().edge_mm, 4, 1e-12);
}

}  // namespace
}  // namespace kinetix::testing
