#include "targets/display/pix.hpp"

#include <leptonica/allheaders.h>

#include <new>

namespace kinetix::targets {

void PixDeleter::operator()(Pix* pix) const { pixDestroy(&pix); }

PixPointer owned(Pix* pix) {
  if (pix == nullptr) throw std::bad_alloc();
  return PixPointer(pix);
}

}  // namespace kinetix::targets
