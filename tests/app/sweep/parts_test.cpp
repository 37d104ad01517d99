#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <csignal>
#include <utility>

#include "app/io/bytes.hpp"
#include "app/studio/messages/templates.hpp"
#include "app/sweep/plan/edit.hpp"
#include "app/sweep/workers/worker_pools.hpp"
#include "model/base/geometry.hpp"
#include "model/solids/hinge_shape.hpp"
#include "targets/document/edit_document.hpp"
#include "tests/app/sweep/sweep.hpp"
#include "tests/support/bad_input.hpp"

namespace kinetix::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// The expected values are examples of the standard, FIPS 180-4.
TEST(Sha256, IsThatOfTheStandard) {
  EXPECT_EQ(app::sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(app::sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(app::sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(app::sha256(std::string(1'000'000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(DocumentPath, ReadsBackAsWritten) {
  for (const char* text : {"design.theta_deg", "design.hinges[3].t", "a[*].b[0][2]", "a"})
    EXPECT_EQ(to_string(targets::parse_path(text)), text);
  for (const char* text : {"", ".a", "a..b", "a.", "a[", "a[x]", "a[-1]", "[0].a", "a]b[", "a[0]b"})
    EXPECT_NE(refusal([&] { targets::parse_path(text); }), "") << text;
}

TEST(DocumentEditor, FindsAddsAndReplacesNumbers) {
  const targets::Node root = targets::parse_document("a: {b: 1, c: [2, {d: 3}, {d: \"4\"}]}\n", "file.yaml");
  targets::DocumentEditor editor(root);
  EXPECT_THAT(editor.numbers(), ElementsAre("a.b", "a.c[0]", "a.c[1].d"));
  EXPECT_THAT(editor.find(targets::parse_path("a.c[*].d")), ::testing::SizeIs(1));
  EXPECT_THAT(editor.find(targets::parse_path("a.x")), IsEmpty());
  const auto added = editor.find_or_add(targets::parse_path("e.f"));
  ASSERT_EQ(added.size(), 1u);
  EXPECT_FALSE(editor.number(added[0]));
  editor.set(added[0], 0.1);
  editor.set(editor.find(targets::parse_path("a.b"))[0], -7);
  EXPECT_EQ(editor.root().optional("e")->optional("f")->number(), 0.1);
  EXPECT_EQ(editor.root().optional("a")->optional("b")->number(), -7);
  EXPECT_EQ(root.optional("a")->optional("b")->number(), 1);
}

TEST(DocumentEditor, PutsValuesInPlaceOfOthers) {
  const targets::Node root = targets::parse_document("a: {b: 1}\nh: {kind: pin, x: [1, 2]}\n", "file.yaml");
  targets::DocumentEditor editor(root);
  editor.put(targets::parse_path("h"), "{kind: block, list: [3, {d: 4}]}");
  editor.put(targets::parse_path("a.c.d"), "word");
  editor.put(targets::parse_path("bed_mm"), "[220, 200]");
  const targets::Node changed = editor.root();
  EXPECT_EQ(changed.optional("h")->optional("kind")->text(""), "block");
  EXPECT_FALSE(changed.optional("h")->optional("x"));
  EXPECT_EQ(changed.optional("h")->optional("list")->list("")[1].optional("d")->number(), 4);
  EXPECT_EQ(changed.optional("a")->optional("c")->optional("d")->text(""), "word");
  EXPECT_EQ(changed.optional("a")->optional("b")->number(), 1);
  EXPECT_EQ(changed.optional("bed_mm")->list("").size(), 2u);
  EXPECT_EQ(root.optional("h")->optional("kind")->text(""), "pin") << "the document itself stays";
  EXPECT_NE(refusal([&] { editor.put(targets::parse_path("a.b.c"), "1"); }), "");
  EXPECT_NE(refusal([&] { editor.put(targets::parse_path("a"), "{"); }), "");
}

TEST(Edit, WritesEachNumberOfAHingeAndItsMirrorImage) {
  using Kind = app::Edit::Kind;
  for (const bool flipped : {false, true}) {
    app::Design design = app::studio::template_design("panel");  // cells of 10 mm
    const model::HingeParameters& hinge = std::as_const(design.structure).hinge(3);
    const auto write = [&](Kind kind, double value) {
      app::apply({.kind = kind, .index = 3, .flipped = flipped}, value, design);
    };
    write(Kind::t, 0.4);
    EXPECT_NEAR(hinge.t, flipped ? 0.6 : 0.4, 1e-15);
    write(Kind::t_mm, 3);
    EXPECT_NEAR(hinge.t, flipped ? 0.7 : 0.3, 1e-15);
    write(Kind::alpha_deg, 70);
    EXPECT_NEAR(to_degrees(hinge.alpha), flipped ? 110 : 70, 1e-12);
    write(Kind::beta_deg, 12);
    EXPECT_NEAR(to_degrees(hinge.beta), flipped ? -12 : 12, 1e-12);
    write(Kind::offset_mm, 0.8);
    EXPECT_NEAR(hinge.offset, flipped ? -0.08 : 0.08, 1e-15);
    EXPECT_THROW(write(Kind::alpha_deg, 180), InvalidInput);
    EXPECT_THROW(write(Kind::offset_mm, 6), InvalidInput);
  }
}

TEST(WorkMessage, KeepsEveryBit) {
  const app::SampleRow row{
      7, {0.1, -0.0}, {std::nan(""), 1e-320}, app::SampleStatus::missed, "why, \"so\"\n"};
  const app::WorkRequest back = app::read_request(to_bytes(app::WorkRequest{{row}, 3, "bye"}));
  EXPECT_EQ(back.wanted, 3u);
  EXPECT_EQ(back.farewell, "bye");
  EXPECT_EQ(back.rows[0].sample, 7);
  EXPECT_TRUE(std::signbit(back.rows[0].factors[1]));
  EXPECT_TRUE(std::isnan(back.rows[0].responses[0]));
  EXPECT_EQ(back.rows[0].responses[1], 1e-320);
  EXPECT_EQ(back.rows[0].status, app::SampleStatus::missed);
  EXPECT_EQ(back.rows[0].reason, row.reason);
  EXPECT_THAT(app::read_samples(app::to_bytes(std::vector<std::int64_t>{3, 1 << 30})),
              ElementsAre(3, 1 << 30));
}

TEST(WorkQueue, HandsOutWhatIsMissingOnce) {
  app::WorkQueue queue({false, true, false, false});
  EXPECT_THAT(queue.take(2), ElementsAre(0, 2));
  EXPECT_THAT(queue.take(5), ElementsAre(3));
  EXPECT_THAT(queue.take(1), IsEmpty());
}

/// An evaluator with samples that throw, end their process, or crash it.
class Troubled final : public app::Evaluator {
 public:
  void evaluate(app::SampleRow& row) override {
    if (row.sample == 3) throw std::runtime_error("three is not to my liking");
    if (row.sample == 5) {
      std::signal(SIGSEGV, SIG_DFL);  // a sanitizer installs another handler
      std::raise(SIGSEGV);
    }
    if (row.sample == 6) _exit(9);
    row.responses[0] = static_cast<double>(row.sample);
  }
};

TEST(ProcessPool, ASampleThatEndsItsProcessIsAFailureAndTheOthersAreDone) {
  const Scratch scratch;
  scratch.write("strip.yaml", strip);
  const app::SweepPlan plan = app::make_sweep_plan(
      scratch.write("doe.yaml", sweep_of("{kind: monte_carlo, samples: 12}",
                                         "  - {path: design.theta_deg, range: [5, 40]}\n", "end_mm")),
      {});
  for (const int processes : {1, 2, 5}) {
    app::WorkQueue queue(std::vector<bool>(12, false));
    std::vector<app::SampleRow> rows(12);
    int count = 0;
    const app::WorkSource source = {[&](std::size_t n) { return queue.take(n); },
                                    [&](const std::vector<app::SampleRow>& more) {
                                      for (const app::SampleRow& row : more)
                                        rows[static_cast<std::size_t>(row.sample)] = row;
                                      count += static_cast<int>(more.size());
                                    }};
    run_in_processes(plan, processes, source,
                     [](const app::SweepPlan&) { return std::make_unique<Troubled>(); });
    EXPECT_EQ(count, 12);
    for (const std::int64_t sample : {0, 1, 2, 4, 7, 8, 9, 10, 11}) {
      EXPECT_EQ(rows[sample].status, app::SampleStatus::ok);
      EXPECT_EQ(rows[sample].responses[0], static_cast<double>(sample));
    }
    EXPECT_EQ(rows[3].reason, "three is not to my liking");
    EXPECT_THAT(rows[5].reason, HasSubstr("signal 11"));
    EXPECT_THAT(rows[6].reason, HasSubstr("code 9"));
    EXPECT_EQ(rows[6].factors, plan.samples.sample(6));
  }
}

}  // namespace
}  // namespace kinetix::testing
