#pragma once

#include <memory>

struct Pix;  // of leptonica

namespace kinetix::targets {

struct PixDeleter {
  void operator()(Pix* pix) const;
};
using PixPointer = std::unique_ptr<Pix, PixDeleter>;

/// For results that are missing only where memory ran out. @throws std::bad_alloc
PixPointer owned(Pix* pix);

}  // namespace kinetix::targets
