#include "app/exports/data_uri.hpp"

#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>

namespace kinetix::app {

std::string data_uri(const std::string& png) {
  namespace iterators = boost::archive::iterators;
  using Encoded =
      iterators::base64_from_binary<iterators::transform_width<std::string::const_iterator, 6, 8>>;
  std::string text = "data:image/png;base64,";
  text.append(Encoded(png.begin()), Encoded(png.end()));
  text.append((3 - png.size() % 3) % 3, '=');
  return text;
}

}  // namespace kinetix::app
