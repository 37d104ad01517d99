#include <gtest/gtest.h>

#include "app/studio/play/page_updates.hpp"

namespace kinetix::testing {
namespace {

using app::studio::Text;
using app::studio::WaitingTexts;

Text text(const std::string& type, const std::string& words) {
  return {type, std::make_shared<const std::string>(words)};
}

std::string all_of(WaitingTexts& texts) {
  std::string out;
  while (!texts.empty()) out += *texts.take().bytes + " ";
  return out;
}

TEST(WaitingTexts, HoldTheNewestOfWhatDescribesThePresent) {
  WaitingTexts texts;
  for (int k = 0; k < 1000; ++k)
    for (const char* type : {"design", "state", "path", "result", "progress", "hello", "meshes"})
      texts.add(text(type, type + std::to_string(k)));
  EXPECT_EQ(texts.counted_bytes(), 0u);
  EXPECT_EQ(all_of(texts), "meshes999 design999 state999 path999 result999 progress999 hello999 ");
}

TEST(WaitingTexts, HoldEveryAnswerInItsOrderAndCountItsBytes) {
  WaitingTexts texts;
  texts.add(text("error", "one"));
  texts.add(text("state", "old"));
  texts.add(text("saved", "two"));
  texts.add(text("error", "three"));
  texts.add(text("state", "new"));
  EXPECT_EQ(texts.counted_bytes(), 11u);
  EXPECT_EQ(*texts.take().bytes, "one");
  EXPECT_EQ(texts.counted_bytes(), 8u);
  EXPECT_EQ(all_of(texts), "two three new ");
  EXPECT_EQ(texts.counted_bytes(), 0u);
}

/// A page would draw a result over the previous design if the result came before its own design.
TEST(WaitingTexts, KeepADesignBeforeItsResult) {
  WaitingTexts texts;
  texts.add(text("design", "design5"));
  texts.add(text("result", "result5"));
  texts.add(text("design", "design5_saved"));
  EXPECT_EQ(all_of(texts), "design5_saved result5 ");
  texts.add(text("result", "result5"));
  texts.add(text("design", "design6"));
  texts.add(text("result", "result6"));
  EXPECT_EQ(all_of(texts), "design6 result6 ");
}

}  // namespace
}  // namespace kinetix::testing
