#include "app/studio/base64.hpp"

#include <boost/archive/iterators/binary_from_base64.hpp>
#include <boost/archive/iterators/transform_width.hpp>

#include "model/base/invalid_input.hpp"

namespace kinetix::app::studio {

std::string from_base64(std::string_view text) {
  using namespace boost::archive::iterators;
  using Bytes = transform_width<binary_from_base64<const char*>, 8, 6>;
  const InvalidInput wrong("files: must be base64");
  const std::string_view digits = text.substr(0, text.find('='));
  if (text.size() % 4 != 0 || text.size() - digits.size() > 2 ||
      text.find_first_not_of('=', digits.size()) != std::string_view::npos)
    throw wrong;
  try {
    std::string out(Bytes(digits.data()), Bytes(digits.data() + digits.size()));
    out.resize(digits.size() * 3 / 4);
    return out;
  } catch (const dataflow_exception&) {
    throw wrong;
  }
}

}  // namespace kinetix::app::studio
