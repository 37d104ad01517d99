#pragma once

#include <streambuf>
#include <string>
#include <string_view>

namespace kinetix::app {

/// A text without anything that changes how a terminal works or in which order it shows letters: control characters but tab and
/// line end as \uXXXX, as JSON has them, and bytes that are not UTF-8 as \xXX. File names may hold them.
std::string printable(std::string_view text);

/// Makes a text printable on one line: line ends become \n as well.
std::string printable_line(std::string_view text);

/// Makes what std::cout and std::cerr print printable while it lives.
class PrintableStreams {
 public:
  PrintableStreams();
  ~PrintableStreams();
  PrintableStreams(const PrintableStreams&) = delete;
  PrintableStreams& operator=(const PrintableStreams&) = delete;

 private:
  class Buffer : public std::streambuf {
   public:
    explicit Buffer(std::streambuf* to) : to_(to) {}
    std::streambuf* to() const { return to_; }

   protected:
    std::streamsize xsputn(const char* text, std::streamsize count) override;
    int_type overflow(int_type c) override;
    int sync() override { return to_->pubsync(); }

   private:
    std::streambuf* to_;
  };

  Buffer out_, error_;
};

}  // namespace kinetix::app
