#pragma once

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "model/base/invalid_input.hpp"

namespace kinetix::testing {

/// Bad input, its expected place, and the words that the message must contain.
struct BadInput {
  std::string text;
  int line, column;
  std::string key;
  std::vector<std::string> says;
};

/// Runs read() and expects InvalidInput at the place of the case, with every word of its message.
template <class Read>
void expect_refused(const BadInput& bad, const std::string& file, Read&& read) {
  SCOPED_TRACE(bad.text.substr(0, 300));
  try {
    read();
    ADD_FAILURE() << "accepted";
  } catch (const InvalidInput& e) {
    EXPECT_EQ(e.place().file, file) << e.what();
    EXPECT_EQ(e.place().line, bad.line) << e.what();
    EXPECT_EQ(e.place().column, bad.column) << e.what();
    EXPECT_EQ(e.place().key, bad.key) << e.what();
    for (const std::string& words : bad.says) EXPECT_THAT(e.reason(), ::testing::HasSubstr(words));
  }
}

/// Returns the message of the InvalidInput that f throws; empty if it throws none.
template <class F>
std::string refusal(F&& f) {
  try {
    f();
  } catch (const InvalidInput& e) {
    return e.what();
  }
  return {};
}

}  // namespace kinetix::testing
