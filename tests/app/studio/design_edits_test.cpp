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
using ::testing::HasSubstr;

Message hinge_at_offset(const std::string& mm) {
  return Message(R"({"type": "hinge", "index": 3, "offset_mm": )" + mm + "}");
}

/// The studio must be able to read the designs that it saves. A hinge's offset is limited to what can be made.
TEST(DesignEdits, KeepOffsetsToWhatAMadeHingeCanHave) {
  const Message films(R"({"type": "made", "kind": "film", "material": "pp"})");
  const app::Design panel = template_design("panel"), stiff_far = with_hinges(panel, hinge_at_offset("4"));
  const app::Design made = with_manufactured_hinges(panel, films);
  EXPECT_THAT(refusal([&] { with_hinges(made, hinge_at_offset("4")); }), HasSubstr("can sit at most"));
  EXPECT_THAT(refusal([&] { with_manufactured_hinges(stiff_far, films); }), HasSubstr("can sit at most"));
  const app::Design near = with_hinges(made, hinge_at_offset("0.1"));
  const targets::Node text = targets::parse_document(design_text(near), "design.yaml");
  EXPECT_NEAR(app::read_design(text).structure.hinge(3).offset * near.structure.size().edge_mm, 0.1, 1e-12);
}

}  // namespace
}  // namespace kinetix::testing
