#include "app/studio/messages/message.hpp"
#include "app/io/bytes.hpp"
#include "app/studio/play/page_updates.hpp"
#include "model/base/invalid_input.hpp"

namespace kinetix::testing {
namespace {

using app::from_base64;
using app::studio::Message;

TEST(StudioMessage, HasNumbersWithoutExponents) {
  EXPECT_EQ(app::studio::plain_number(1000), "1000");
  EXPECT_EQ(app::studio::plain_number(99'999), "99999");
  EXPECT_EQ(app::studio::plain_number(123'456), "1.23e+05");
  EXPECT_EQ(app::studio::plain_number(0.01234), "0.0123");
  EXPECT_EQ(app::studio::plain_number(2.5, 2), "2.5");
  EXPECT_EQ(app::studio::plain_number(-31.409, 4), "-31.41");
  EXPECT_EQ(app::studio::plain_number(0), "0");
}

TEST(StudioMessage, IsReadStrictly) {
  const Message message(R"({"type": "x", "id": 7, "n": 2, "to": [1, 2.5, -3], "all": [3, 1]})");
  EXPECT_EQ(message.type(), "x");
  EXPECT_EQ(message.id(), 7);
  EXPECT_EQ(message.integer("n", 0, 5), 2);
  EXPECT_EQ(message.point("to"), Eigen::Vector3d(1, 2.5, -3));
  EXPECT_EQ(message.integers("all", 1, 3), (std::vector<int>{3, 1}));
  EXPECT_THROW(message.integer("n", 3, 5), InvalidInput);
  EXPECT_THROW(message.integers("all", 2, 3), InvalidInput);
  EXPECT_THROW(message.boolean("n"), InvalidInput);
  EXPECT_THROW(message.number("missing", 0, 1), InvalidInput);
  EXPECT_THROW(Message("[1]"), InvalidInput);
  EXPECT_THROW(Message(R"({"id": 1})"), InvalidInput);
}

TEST(StudioMessage, HoldsFilesAsBase64) {
  EXPECT_EQ(from_base64(""), "");
  EXPECT_EQ(from_base64("S2luZXRpeA=="), "Kinetix");
  EXPECT_EQ(from_base64("AAECA/8="), std::string("\x00\x01\x02\x03\xff", 5));
  for (const char* wrong : {"A", "AB=C", "A===", "====", "Zm9v Zm9", "Zm9*"})
    EXPECT_THROW(from_base64(wrong), InvalidInput) << wrong;
}

TEST(StudioMessage, IsRefusedWhereItIsNestedTooDeep) {
  const auto nested = [](std::size_t depth) {
    return R"({"type": "x", "n": )" + std::string(depth, '[') + std::string(depth, ']') + "}";
  };
  EXPECT_NO_THROW(Message(nested(63)));
  for (const std::size_t depth : {64u, 100'000u, 700'000u})
    EXPECT_THROW(Message(nested(depth)), InvalidInput);
  EXPECT_THROW(Message(std::string(100'000, '{')), InvalidInput);
}

TEST(StudioFrame, HoldsTenNumbersAndSevenABody) {
  app::studio::Frame frame;
  frame.revision = 3;
  frame.theta = 0.5;
  frame.mode = app::studio::Mode::bullet;
  frame.processed[2] = 9;
  frame.state.resize(2);
  frame.state[1].p = {1, 2, 3};
  frame.state[1].R = Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const std::string bytes = frame_bytes(frame, 5, 2);
  std::vector<double> numbers(bytes.size() / 8);
  std::copy_n(bytes.data(), bytes.size(), reinterpret_cast<char*>(numbers.data()));
  ASSERT_EQ(numbers.size(), 24u);
  EXPECT_EQ(std::vector<double>(numbers.begin(), numbers.begin() + 6),
            (std::vector<double>{1, 5, 3, 0.5, 0, 9}));
  EXPECT_TRUE(std::isnan(numbers[6]));
  EXPECT_EQ(numbers[8], 2);
  EXPECT_EQ(numbers[9], 2);
  EXPECT_EQ(numbers[17], 1);
  EXPECT_NEAR(numbers[20], std::cos(0.2), 1e-15);
  EXPECT_NEAR(numbers[23], std::sin(0.2), 1e-15);
}

}  // namespace
}  // namespace kinetix::testing
