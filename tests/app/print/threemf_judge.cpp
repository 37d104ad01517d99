#include "tests/app/print/threemf_judge.hpp"

#include <Model/COM/NMR_DLLInterfaces.h>

namespace kinetix::testing {
namespace {

/// Owner of one reference to an object of lib3mf.
template <class Object>
struct Owned {
  Object* object = nullptr;
  Owned() = default;
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;
  ~Owned() {
    if (object) NMR::lib3mf_release(object);
  }
};

bool fine(int result) { return result == 0; }

void look_at(NMR::PLib3MFModelResourceIterator* meshes, ThreemfVerdict& verdict) {
  BOOL there = false;
  while (fine(NMR::lib3mf_resourceiterator_movenext(meshes, &there)) && there) {
    Owned<NMR::PLib3MFModelResource> mesh;
    BOOL manifold = false;
    DWORD triangles = 0;
    verdict.manifold &= fine(NMR::lib3mf_resourceiterator_getcurrent(meshes, &mesh.object)) &&
                        fine(NMR::lib3mf_meshobject_ismanifoldandoriented(mesh.object, &manifold)) &&
                        fine(NMR::lib3mf_meshobject_gettrianglecount(mesh.object, &triangles)) && manifold;
    verdict.triangles += static_cast<int>(triangles);
    ++verdict.objects;
  }
}

}  // namespace

ThreemfVerdict read_threemf(const std::string& file) {
  ThreemfVerdict verdict;
  Owned<NMR::PLib3MFModel> model;
  Owned<NMR::PLib3MFModelReader> reader;
  Owned<NMR::PLib3MFModelResourceIterator> meshes;
  DWORD warnings = 0;
  verdict.is_read = fine(NMR::lib3mf_createmodel(&model.object)) &&
                    fine(NMR::lib3mf_model_queryreader(model.object, "3mf", &reader.object)) &&
                    fine(NMR::lib3mf_reader_readfromfileutf8(reader.object, file.c_str())) &&
                    fine(NMR::lib3mf_reader_getwarningcount(reader.object, &warnings)) &&
                    fine(NMR::lib3mf_model_getmeshobjects(model.object, &meshes.object));
  if (!verdict.is_read) return verdict;
  verdict.warnings = static_cast<int>(warnings);
  verdict.manifold = true;
  look_at(meshes.object, verdict);
  return verdict;
}

}  // namespace kinetix::testing
