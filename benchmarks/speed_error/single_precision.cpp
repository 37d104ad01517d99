#include <LinearMath/btScalar.h>

static_assert(sizeof(btScalar) == sizeof(float), "built against the engine in double precision");
