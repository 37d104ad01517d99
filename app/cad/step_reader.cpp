// kinetix-read-step CPU_S BYTES FILE reads all solids of a STEP file by OpenCASCADE and writes them as solid_bytes.hpp
// does. app/cad/cad_formats.cpp starts it. It may crash.
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRep_Tool.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Poly_Triangulation.hxx>
#include <Quantity_Color.hxx>
#include <STEPCAFControl_Reader.hxx>
#include <Standard_Failure.hxx>
#include <Standard_OutOfMemory.hxx>
#include <TDF_LabelSequence.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <stdexcept>

#include "app/cad/solid_bytes.hpp"
#include "app/io/reader_program.hpp"

namespace kinetix::app::cad {
namespace {

constexpr double deflection_mm = 0.002;  // mm, curved face to triangles: a tenth of the accuracy for hinges
constexpr double deflection_rad = 0.2;   // rad between neighbouring facets: circles get 32 sides or more

std::string name_of(const TDF_Label& label) {
  Handle(TDataStd_Name) name;
  if (!label.FindAttribute(TDataStd_Name::GetID(), name)) return {};
  std::string out(static_cast<std::size_t>(name->Get().LengthOfCString()), '\0');
  Standard_PCharacter text = out.data();
  name->Get().ToUTF8CString(text);
  return out;
}

std::string colour_text(const Quantity_Color& colour) {
  double r = 0, g = 0, b = 0;
  colour.Values(r, g, b, Quantity_TOC_sRGB);
  char text[8];
  const auto byte = [](double x) { return static_cast<unsigned>(std::lround(255 * x)) & 255u; };
  std::snprintf(text, sizeof text, "#%02x%02x%02x", byte(r), byte(g), byte(b));
  return text;
}

/// Triangulates all faces of a solid, with corners counter-clockwise from outside.
FoundSolid triangles_of(const TopoDS_Shape& solid) {
  BRepMesh_IncrementalMesh(solid, deflection_mm, false, deflection_rad, false);
  FoundSolid out;
  for (TopExp_Explorer faces(solid, TopAbs_FACE); faces.More(); faces.Next()) {
    const TopoDS_Face& face = TopoDS::Face(faces.Current());
    TopLoc_Location place;
    const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(face, place);
    if (mesh.IsNull()) continue;
    const int first = static_cast<int>(out.points.size());
    for (int k = 1; k <= mesh->NbNodes(); ++k) {
      const gp_Pnt p = mesh->Node(k).Transformed(place.Transformation());
      out.points.emplace_back(p.X(), p.Y(), p.Z());
    }
    for (int k = 1; k <= mesh->NbTriangles(); ++k) {
      int a = 0, b = 0, c = 0;
      mesh->Triangle(k).Get(a, b, c);
      if (face.Orientation() == TopAbs_REVERSED) std::swap(b, c);
      out.triangles.push_back({first + a - 1, first + b - 1, first + c - 1});
    }
  }
  return out;
}

class StepModel {
 public:
  explicit StepModel(const std::string& file) {
    XCAFApp_Application::GetApplication()->NewDocument("MDTV-XCAF", document_);
    STEPCAFControl_Reader reader;
    reader.SetNameMode(true);
    reader.SetColorMode(true);
    if (reader.ReadFile(file.c_str()) != IFSelect_RetDone || !reader.Transfer(document_))
      throw std::runtime_error("is not a STEP file, or is damaged");
    shapes_ = XCAFDoc_DocumentTool::ShapeTool(document_->Main());
    colours_ = XCAFDoc_DocumentTool::ColorTool(document_->Main());
  }

  std::vector<FoundSolid> read() {
    TDF_LabelSequence roots;
    shapes_->GetFreeShapes(roots);
    for (int k = 1; k <= roots.Length(); ++k) add(roots.Value(k), {}, name_of(roots.Value(k)), "");
    return std::move(out_);
  }

 private:
  std::string colour_of(const TDF_Label& label, const std::string& otherwise) const {
    Quantity_Color colour;
    for (const XCAFDoc_ColorType kind : {XCAFDoc_ColorGen, XCAFDoc_ColorSurf})
      if (colours_->GetColor(label, kind, colour)) return colour_text(colour);
    return otherwise;
  }

  std::string colour_of_shape(const TopoDS_Shape& shape, const std::string& otherwise) const {
    Quantity_Color colour;
    for (const XCAFDoc_ColorType kind : {XCAFDoc_ColorGen, XCAFDoc_ColorSurf})
      if (colours_->GetColor(shape, kind, colour)) return colour_text(colour);
    return otherwise;
  }

  /// Adds the solids of a label. A reference keeps its own name and place and uses the shape that it refers to.
  void add(const TDF_Label& label, const TopLoc_Location& above, const std::string& name,
           const std::string& colour) {
    TDF_Label shape = label;
    TopLoc_Location place = above;
    std::string own = colour_of(label, colour);
    if (XCAFDoc_ShapeTool::IsReference(label)) {
      place = above * XCAFDoc_ShapeTool::GetLocation(label);
      XCAFDoc_ShapeTool::GetReferredShape(label, shape);
      own = colour_of(shape, own);
    }
    if (!XCAFDoc_ShapeTool::IsAssembly(shape)) return add_solids(shape, place, name, own);
    TDF_LabelSequence parts;
    XCAFDoc_ShapeTool::GetComponents(shape, parts);
    for (int k = 1; k <= parts.Length(); ++k) {
      const std::string part = name_of(parts.Value(k));
      add(parts.Value(k), place, part.empty() ? name : part, own);
    }
  }

  void add_solids(const TDF_Label& label, const TopLoc_Location& place, const std::string& name,
                  const std::string& colour) {
    for (TopExp_Explorer solids(XCAFDoc_ShapeTool::GetShape(label), TopAbs_SOLID); solids.More();
         solids.Next()) {
      FoundSolid found = triangles_of(solids.Current());
      found.name = name;
      found.colour = colour_of_shape(solids.Current(), colour);
      for (Eigen::Vector3d& p : found.points) {
        const gp_Pnt at = gp_Pnt(p.x(), p.y(), p.z()).Transformed(place.Transformation());
        p = {at.X(), at.Y(), at.Z()};
      }
      out_.push_back(std::move(found));
    }
  }

  Handle(TDocStd_Document) document_;
  Handle(XCAFDoc_ShapeTool) shapes_;
  Handle(XCAFDoc_ColorTool) colours_;
  std::vector<FoundSolid> out_;
};

/// Sends what the library prints to /dev/null. @return descriptor of the original standard output
int take_output() {
  const int out = dup(STDOUT_FILENO), nowhere = open("/dev/null", O_WRONLY);
  dup2(nowhere, STDOUT_FILENO);
  Message::DefaultMessenger()->ChangePrinters().Clear();
  return out;
}

/// Sets the soft limit and keeps the hard one: SIGKILL, sent at the hard limit of CPU time, gives no reason.
void limit(__rlimit_resource resource, rlim_t most) {
  rlimit now{};
  getrlimit(resource, &now);
  now.rlim_cur = std::min(most, now.rlim_max);
  setrlimit(resource, &now);
}

/// Sets resource limits. This process ends with the program that started it, which handles Ctrl-C.
void set_limits(const char* cpu_s, const char* bytes) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  std::signal(SIGINT, SIG_IGN);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, std::strtoul(cpu_s, nullptr, 10));
#ifndef __SANITIZE_ADDRESS__  // the sanitizer reserves far more addresses than there is memory
  limit(RLIMIT_AS, std::strtoul(bytes, nullptr, 10));
#else
  static_cast<void>(bytes);
#endif
}

bool write_all(int to, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(to, bytes.data(), bytes.size());
    if (count <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

}  // namespace
}  // namespace kinetix::app::cad

/// Ends by _exit while the model still exists: destructors of data from a damaged file may crash, too.
int main(int argc, char** argv) {
  if (argc != 4) return 1;
  using namespace kinetix::app;
  const auto end = [](ReaderEnd how) { _exit(static_cast<int>(how)); };
  cad::set_limits(argv[1], argv[2]);
  const int out = cad::take_output();
  try {
    if (!cad::write_all(out, cad::to_bytes((new cad::StepModel(argv[3]))->read()))) abort();
    end(ReaderEnd::done);
  } catch (const std::bad_alloc&) {
    end(ReaderEnd::out_of_memory);
  } catch (const Standard_OutOfMemory&) {
    end(ReaderEnd::out_of_memory);
  } catch (const Standard_Failure& e) {
    cad::write_all(out, std::string("is damaged: ") + e.GetMessageString());
    end(ReaderEnd::refused);
  } catch (const std::exception& e) {
    cad::write_all(out, e.what());
    end(ReaderEnd::refused);
  }
}
