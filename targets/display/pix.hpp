#pragma once

#include <memory>

struct Pix;  // of leptonica

namespace kinetix::targets {

struct PixDeleter {
  void operator()(Pix* pix) const;
};
using PixPointer = std::unique_ptr<Pix, PixDeleter>;

/// Takes ownership of a result that is null only if memory ran out. @throws std::bad_alloc for null
PixPointer owned(Pix* pix);

}  // namespace kinetix::targets
