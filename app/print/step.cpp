#include <unistd.h>
#include <APIHeaderSection_MakeHeader.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Quantity_Color.hxx>
#include <STEPCAFControl_Writer.hxx>
#include <STEPConstruct.hxx>
#include <STEPConstruct_Styles.hxx>
#include <StepData_StepModel.hxx>
#include <StepVisual_Colour.hxx>
#include <StepVisual_MechanicalDesignGeometricPresentationRepresentation.hxx>
#include <StepVisual_PresentationStyleAssignment.hxx>
#include <StepVisual_StyledItem.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <gp_Circ.hxx>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <stdexcept>

#include "app/print/formats.hpp"

namespace kinetix::app {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using model::ArmSolid;

constexpr double sewn_mm = 1e-6;  // mm: corners of neighbouring faces are the same numbers

// Red, green and blue of the screen from 0 to 1: as the 3MF files have them.
const Quantity_Color hard_colour(0.847, 0.847, 0.824, Quantity_TOC_sRGB);
const Quantity_Color soft_colour(0.180, 0.435, 0.718, Quantity_TOC_sRGB);

gp_Pnt to_occt(const Vector3d& p) { return {p.x(), p.y(), p.z()}; }
gp_Vec vector_of(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

TopoDS_Face flat_face(const std::vector<Vector3d>& corners) {
  BRepBuilderAPI_MakePolygon wire;
  for (const Vector3d& p : corners) wire.Add(to_occt(p));
  wire.Close();
  return BRepBuilderAPI_MakeFace(wire.Wire(), true);
}

TopoDS_Shape polyhedron(const std::vector<Vector3d>& points, const std::vector<std::vector<int>>& faces) {
  BRepBuilderAPI_Sewing sewing(sewn_mm);
  for (const std::vector<int>& face : faces) {
    std::vector<Vector3d> corners;
    for (const int k : face) corners.push_back(points[k]);
    sewing.Add(flat_face(corners));
  }
  sewing.Perform();
  TopExp_Explorer shell(sewing.SewedShape(), TopAbs_SHELL);
  if (!shell.More()) throw std::runtime_error("STEP: faces of a solid do not meet");
  TopoDS_Solid solid = BRepBuilderAPI_MakeSolid(TopoDS::Shell(shell.Current()));
  return solid;
}

TopoDS_Shape plate(const ArmSolid& arm) {
  std::vector<Vector3d> points = arm.start_corners();
  const double half = arm.size.thickness_mm / 2, high = arm.size.height_mm / 2;
  for (const double s : {-high, high})
    for (const double n : {-half, half}) points.push_back(arm.point({-arm.end.wall_end, n}, s));
  return polyhedron(points,
                    {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}});
}

TopoDS_Wire circle_wire(const ArmSolid& arm, double radius, double s) {
  const gp_Ax2 frame(to_occt(arm.point({0, arm.end.axis_across}, s)), gp_Dir(vector_of(arm.axis)),
                     gp_Dir(vector_of(arm.towards_axis)));
  return BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(gp_Circ(frame, radius)));
}

/// Where the line from a point outside touches the circle about the axis. @param turn 1: counter-clockwise of it
Vector2d touching(const Vector2d& from, const Vector2d& axis, double radius, double turn) {
  const Vector2d u = (from - axis).normalized();
  const double angle = turn * std::acos(radius / (from - axis).norm());
  return axis + radius * Vector2d(std::cos(angle) * u.x() - std::sin(angle) * u.y(),
                                  std::sin(angle) * u.x() + std::cos(angle) * u.y());
}

/// From the wall's corners tangents to the knuckle's circle.
TopoDS_Wire knuckle_wire(const ArmSolid& arm, double s) {
  const model::HingeEnd& end = arm.end;
  const Vector2d axis(0, end.axis_across), low = end.section.front(), high = end.section.back(),
                                           first = touching(low, axis, end.knuckle_radius, 1),
                                           last = touching(high, axis, end.knuckle_radius, -1),
                                           outermost = axis + Vector2d(end.knuckle_radius, 0);
  const auto at = [&](const Vector2d& p) { return to_occt(arm.point(p, s)); };
  BRepBuilderAPI_MakeWire wire;
  wire.Add(BRepBuilderAPI_MakeEdge(at(low), at(first)));
  wire.Add(BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(at(first), at(outermost), at(last)).Value()));
  wire.Add(BRepBuilderAPI_MakeEdge(at(last), at(high)));
  wire.Add(BRepBuilderAPI_MakeEdge(at(high), at(low)));
  return wire;
}

TopoDS_Wire section_wire(const ArmSolid& arm, double s) {
  if (arm.end.knuckle_radius > 0) return knuckle_wire(arm, s);
  BRepBuilderAPI_MakePolygon wire;
  for (const Vector2d& p : arm.end.section) wire.Add(to_occt(arm.point(p, s)));
  wire.Close();
  return wire;
}

TopoDS_Shape lug(const ArmSolid& arm, const model::HingeEnd::Lug& at) {
  BRepBuilderAPI_MakeFace face(section_wire(arm, at.from), true);
  if (arm.end.bore_radius > 0)
    face.Add(TopoDS::Wire(circle_wire(arm, arm.end.bore_radius, at.from).Reversed()));
  return BRepPrimAPI_MakePrism(face.Face(), vector_of((at.to - at.from) * arm.axis));
}

TopoDS_Shape rod(const ArmSolid& arm) {
  const double from = arm.end.lugs.front().to, to = arm.end.lugs.back().from;
  return BRepPrimAPI_MakePrism(
      BRepBuilderAPI_MakeFace(circle_wire(arm, arm.end.rod_radius, from), true).Face(),
      vector_of((to - from) * arm.axis));
}

/// Of pieces that share faces or parts of them.
TopoDS_Shape fused(const TopTools_ListOfShape& pieces) {
  if (pieces.Size() == 1) return pieces.First();
  TopTools_ListOfShape first, rest(pieces);
  first.Append(rest.First());
  rest.RemoveFirst();
  BRepAlgoAPI_Fuse fuse;
  fuse.SetArguments(first);
  fuse.SetTools(rest);
  fuse.SetGlue(BOPAlgo_GlueShift);
  fuse.Build();
  if (fuse.HasErrors()) throw std::runtime_error("STEP: the pieces of a body cannot be fused");
  fuse.SimplifyResult(true, true, sewn_mm);
  return fuse.Shape();
}

TopoDS_Shape brep_of(const model::BodySolid& body) {
  TopTools_ListOfShape pieces;
  pieces.Append(polyhedron(body.junction.corners, body.junction.faces));
  for (const ArmSolid& arm : body.arms) {
    pieces.Append(plate(arm));
    for (const model::HingeEnd::Lug& at : arm.end.lugs) pieces.Append(lug(arm, at));
    if (arm.end.rod_radius > 0) pieces.Append(rod(arm));
  }
  const TopoDS_Shape whole = fused(pieces);
  TopExp_Explorer solids(whole, TopAbs_SOLID);
  if (!solids.More()) throw std::runtime_error("STEP: a body is no solid");
  const TopoDS_Shape solid = solids.Current();
  solids.Next();
  if (solids.More()) throw std::runtime_error("STEP: a body falls into several solids");
  return solid;
}

/// A loose rod, relative to the lower body.
TopoDS_Shape rod_of(const PrintSheet& sheet, int hinge) {
  Vector3d at = Vector3d::Zero();
  const std::vector<Vector3d>& corners = sheet.rods[hinge].points;
  for (const Vector3d& corner : corners) at += corner / static_cast<double>(corners.size());
  const Vector3d axis = sheet.linkage.hinges[hinge].axis;
  const model::MadeHinge& made = sheet.hinges[hinge].made;
  const gp_Ax2 frame(to_occt(at - made.height_mm / 2 * axis), gp_Dir(vector_of(axis)));
  const TopoDS_Wire circle =
      BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(gp_Circ(frame, made.diameter_mm / 2)));
  return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(circle, true).Face(),
                               vector_of(made.height_mm * axis));
}

/// A block at rest has flat faces; one that was stretched is given by its triangles.
TopoDS_Shape block_of(const model::Polyhedron& block, bool stretched) {
  if (!stretched)
    return polyhedron(block.points,
                      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}});
  std::vector<std::vector<int>> faces;
  for (const auto& t : block.triangles) faces.push_back({t.begin(), t.end()});
  return polyhedron(block.points, faces);
}

TopLoc_Location location_of(const model::Pose& pose) {
  const Eigen::Matrix3d& R = pose.R;
  gp_Trsf t;
  t.SetValues(R(0, 0), R(0, 1), R(0, 2), pose.p.x(), R(1, 0), R(1, 1), R(1, 2), pose.p.y(), R(2, 0), R(2, 1),
              R(2, 2), pose.p.z());
  return t;
}

void set_name(const TDF_Label& label, const std::string& name) {
  TDataStd_Name::Set(label, TCollection_ExtendedString(name.c_str(), true));
}

/// Of a shape that was translated. The writer itself would write colours in an order that differs from run to run.
void add_colour(const TopoDS_Shape& shape, const Quantity_Color& colour, STEPCAFControl_Writer& writer) {
  STEPConstruct_Styles styles(writer.ChangeWriter().WS());
  const Handle(StepVisual_Colour) encoded = STEPConstruct_Styles::EncodeColor(colour);
  const Handle(StepRepr_RepresentationItem) item = STEPConstruct::FindEntity(styles.FinderProcess(), shape);
  if (item.IsNull()) throw std::runtime_error("STEP: a solid was not translated");
  styles.AddStyle(item, styles.MakeColorPSA(item, encoded, encoded, nullptr, 0), nullptr);
  Handle(StepVisual_MechanicalDesignGeometricPresentationRepresentation) all;
  if (!styles.CreateMDGPR(styles.FindContext(shape), all))
    throw std::runtime_error("STEP: a colour cannot be written");
  writer.ChangeWriter().Model()->AddWithRefs(all);
}

/// The sheet as an assembly; bodies of one shape refer to it.
class Assembly {
 public:
  explicit Assembly(const PrintJob& job) : job_(job) {
    XCAFApp_Application::GetApplication()->NewDocument("MDTV-XCAF", document_);
    shapes_ = XCAFDoc_DocumentTool::ShapeTool(document_->Main());
    root_ = shapes_->NewShape();
    set_name(root_, job.sheet.name);
  }
  ~Assembly() { XCAFApp_Application::GetApplication()->Close(document_); }
  Assembly(const Assembly&) = delete;
  Assembly& operator=(const Assembly&) = delete;

  void build() {
    const PrintSheet& sheet = job_.sheet;
    for (int b = 0; b < static_cast<int>(sheet.bodies.size()); ++b)
      if (!sheet.meshes[b].points.empty())
        add(body_label(b), location_of(job_.state()[b]), "body " + sheet.linkage.vertex_name(b));
    for (int h = 0; h < static_cast<int>(sheet.rods.size()); ++h)
      if (!sheet.rods[h].points.empty())
        add(shape_label(rod_of(sheet, h), "rod", hard_colour),
            location_of(job_.state()[sheet.linkage.hinges[h].lower]), "rod " + sheet.linkage.wall_name(h));
    for (int h = 0; h < static_cast<int>(sheet.soft.size()); ++h)
      if (!sheet.soft[h].points.empty())
        add(shape_label(block_of(placed_soft(sheet, job_.state(), h), job_.folded), "hinge", soft_colour), {},
            "hinge " + sheet.linkage.wall_name(h));
    shapes_->UpdateAssemblies();
  }

  void write(const std::string& file) {
    STEPCAFControl_Writer writer;
    writer.SetColorMode(false);  // add_colour does
    if (!writer.Transfer(document_)) throw std::runtime_error("STEP: the sheet cannot be translated");
    for (const auto& [shape, colour] : colours_) add_colour(shape, colour, writer);
    APIHeaderSection_MakeHeader header(writer.ChangeWriter().Model());
    header.SetTimeStamp(new TCollection_HAsciiString("1970-01-01T00:00:00"));  // the same bytes each time
    header.SetName(new TCollection_HAsciiString(job_.sheet.name.c_str()));
    if (writer.Write(file.c_str()) != IFSelect_RetDone)
      throw std::runtime_error("STEP: the file cannot be written");
  }

 private:
  void add(const TDF_Label& shape, const TopLoc_Location& where, const std::string& name) {
    set_name(shapes_->AddComponent(root_, shape, where), name);
  }

  TDF_Label shape_label(const TopoDS_Shape& shape, const std::string& name, const Quantity_Color& colour) {
    const TDF_Label label = shapes_->AddShape(shape, false);
    set_name(label, name);
    colours_.emplace_back(shape, colour);
    return label;
  }

  TDF_Label body_label(int body) {
    std::vector<double> key;
    for (const Vector3d& p : job_.sheet.meshes[body].points)
      for (const double x : p) key.push_back(std::round(x / sewn_mm));
    const auto known = bodies_.find(key);
    if (known != bodies_.end()) return known->second;
    const std::string name = "type " + std::to_string(bodies_.size() + 1);
    return bodies_[key] = shape_label(brep_of(job_.sheet.bodies[body]), name, hard_colour);
  }

  const PrintJob& job_;
  Handle(TDocStd_Document) document_;
  Handle(XCAFDoc_ShapeTool) shapes_;
  TDF_Label root_;
  std::vector<std::pair<TopoDS_Shape, Quantity_Color>> colours_;  // of all shapes, in their order
  std::map<std::vector<double>, TDF_Label> bodies_;
};

/// The library writes to named files only.
class TemporaryFile {
 public:
  TemporaryFile() {
    name_ = (std::filesystem::temp_directory_path() / "kinetix-step-XXXXXX").string();
    const int descriptor = mkstemp(name_.data());
    if (descriptor < 0) throw std::runtime_error("STEP: no temporary file can be made");
    close(descriptor);
  }
  ~TemporaryFile() { std::filesystem::remove(name_, ignored_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::string& name() const { return name_; }
  std::string content() const {
    std::ifstream in(name_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

 private:
  std::string name_;
  std::error_code ignored_;
};

std::vector<NamedContent> write_step(const PrintJob& job) {
  Message::DefaultMessenger()->ChangePrinters().Clear();  // it would write to stdout
  const TemporaryFile file;
  Assembly assembly(job);
  assembly.build();
  assembly.write(file.name());
  return {{job.sheet.name + ".step", file.content()}};
}

}  // namespace

// Name, meaning and how it is written: step.
const PrintFormat step_format = {"step", "CAD, with true cylinders", write_step};

}  // namespace kinetix::app
