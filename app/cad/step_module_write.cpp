#include <APIHeaderSection_MakeHeader.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Quantity_Color.hxx>
#include <STEPCAFControl_Writer.hxx>
#include <STEPConstruct.hxx>
#include <STEPConstruct_Styles.hxx>
#include <StepData_Protocol.hxx>
#include <StepData_StepModel.hxx>
#include <StepData_StepWriter.hxx>
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
#include <XSControl_WorkSession.hxx>
#include <gp_Circ.hxx>
#include <sstream>
#include <stdexcept>

#include "app/cad/product.hpp"

namespace kinetix::app::cad {
namespace {

using Eigen::Vector3d;

constexpr double sewn_mm = 1e-6;  // mm: corners of neighbouring faces are the same numbers

gp_Pnt to_occt(const Vector3d& p) { return {p.x(), p.y(), p.z()}; }
gp_Vec vector_of(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

TopoDS_Face flat_face(const std::vector<Vector3d>& corners) {
  BRepBuilderAPI_MakePolygon wire;
  for (const Vector3d& p : corners) wire.Add(to_occt(p));
  wire.Close();
  return BRepBuilderAPI_MakeFace(wire.Wire(), true);
}

TopoDS_Shape built(const Faceted& solid) {
  BRepBuilderAPI_Sewing sewing(sewn_mm);
  for (const std::vector<int>& face : solid.faces) {
    std::vector<Vector3d> corners;
    for (const int k : face) corners.push_back(solid.points[k]);
    sewing.Add(flat_face(corners));
  }
  sewing.Perform();
  TopExp_Explorer shell(sewing.SewedShape(), TopAbs_SHELL);
  if (!shell.More()) throw std::runtime_error("STEP: faces of a solid do not meet");
  return BRepBuilderAPI_MakeSolid(TopoDS::Shell(shell.Current())).Solid();
}

gp_Ax2 frame_of(const Circle& circle) {
  return {to_occt(circle.centre), gp_Dir(vector_of(circle.axis)), gp_Dir(vector_of(circle.first))};
}

TopoDS_Wire wire_of(const Circle& circle) {
  return BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(gp_Circ(frame_of(circle), circle.radius)));
}

TopoDS_Wire wire_of(const Contour& contour) {
  BRepBuilderAPI_MakeWire wire;
  Vector3d from = contour.start;
  for (const ContourStep& edge : contour.edges) {
    if (edge.through)
      wire.Add(BRepBuilderAPI_MakeEdge(
          GC_MakeArcOfCircle(to_occt(from), to_occt(*edge.through), to_occt(edge.to)).Value()));
    else
      wire.Add(BRepBuilderAPI_MakeEdge(to_occt(from), to_occt(edge.to)));
    from = edge.to;
  }
  return wire;
}

TopoDS_Shape built(const Frustum& frustum) {
  return BRepPrimAPI_MakeCone(frame_of(frustum.base), frustum.base.radius, frustum.end_radius, frustum.along)
      .Solid();
}

/// Cuts the cones `sinks` from `whole`. @return the first solid that remains
TopoDS_Shape without(const TopoDS_Shape& whole, const std::vector<Frustum>& sinks) {
  TopTools_ListOfShape first, tools;
  first.Append(whole);
  for (const Frustum& sink : sinks) tools.Append(built(sink));
  BRepAlgoAPI_Cut cut;
  cut.SetArguments(first);
  cut.SetTools(tools);
  cut.Build();
  TopExp_Explorer left(cut.Shape(), TopAbs_SOLID);
  if (cut.HasErrors() || !left.More()) throw std::runtime_error("STEP: a cone cannot be taken from a body");
  return left.Current();
}

TopoDS_Shape built(const Prism& prism) {
  const TopoDS_Wire base = std::visit([](const auto& b) { return wire_of(b); }, prism.base);
  BRepBuilderAPI_MakeFace face(base, true);
  if (prism.hole) face.Add(TopoDS::Wire(wire_of(*prism.hole).Reversed()));
  const TopoDS_Shape whole = BRepPrimAPI_MakePrism(face.Face(), vector_of(prism.along));
  return prism.sinks.empty() ? whole : without(whole, prism.sinks);
}

/// Fuses pieces that share faces or parts of faces.
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

TopoDS_Shape solid_of(const Shape& shape) {
  TopTools_ListOfShape pieces;
  for (const Piece& piece : shape.pieces)
    pieces.Append(std::visit([](const auto& p) { return built(p); }, piece));
  const TopoDS_Shape whole = fused(pieces);
  TopExp_Explorer solids(whole, TopAbs_SOLID);
  if (!solids.More()) throw std::runtime_error("STEP: a body is not a solid");
  const TopoDS_Shape solid = solids.Current();
  solids.Next();
  if (solids.More()) throw std::runtime_error("STEP: a body falls into several solids");
  return solid;
}

TopLoc_Location location_of(const Eigen::Isometry3d& where) {
  const Eigen::Matrix3d R = where.linear();
  const Vector3d p = where.translation();
  gp_Trsf t;
  t.SetValues(R(0, 0), R(0, 1), R(0, 2), p.x(), R(1, 0), R(1, 1), R(1, 2), p.y(), R(2, 0), R(2, 1), R(2, 2),
              p.z());
  return t;
}

void set_name(const TDF_Label& label, const std::string& name) {
  TDataStd_Name::Set(label, TCollection_ExtendedString(name.c_str(), true));
}

/// Adds a colour to a shape that the writer has translated. The writer itself would write colours in an order that
/// differs from run to run.
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

class Document {
 public:
  explicit Document(const Product& product) : product_(product) {
    XCAFApp_Application::GetApplication()->NewDocument("MDTV-XCAF", document_);
    const Handle(XCAFDoc_ShapeTool) shapes = XCAFDoc_DocumentTool::ShapeTool(document_->Main());
    const TDF_Label root = shapes->NewShape();
    set_name(root, product.name);
    std::vector<TDF_Label> labels;
    for (const Shape& shape : product.shapes) {
      solids_.push_back(solid_of(shape));
      labels.push_back(shapes->AddShape(solids_.back(), false));
      set_name(labels.back(), shape.name);
    }
    for (const Part& part : product.parts)
      set_name(shapes->AddComponent(root, labels[part.shape], location_of(part.where)), part.name);
    shapes->UpdateAssemblies();
  }
  ~Document() { XCAFApp_Application::GetApplication()->Close(document_); }
  Document(const Document&) = delete;
  Document& operator=(const Document&) = delete;

  /// Returns the text of the file. It is made in memory, where no disk can be full.
  std::string text() {
    STEPCAFControl_Writer writer;
    writer.SetColorMode(false);  // add_colour does
    if (!writer.Transfer(document_)) throw std::runtime_error("STEP: the sheet cannot be translated");
    for (std::size_t i = 0; i < solids_.size(); ++i) {
      const auto& [red, green, blue] = product_.shapes[i].colour;
      add_colour(solids_[i], Quantity_Color(red, green, blue, Quantity_TOC_sRGB), writer);
    }
    APIHeaderSection_MakeHeader header(writer.ChangeWriter().Model());
    header.SetTimeStamp(new TCollection_HAsciiString("1970-01-01T00:00:00"));  // the same bytes each time
    header.SetName(new TCollection_HAsciiString(product_.name.c_str()));
    StepData_StepWriter lines(writer.ChangeWriter().Model());
    lines.SendModel(Handle(StepData_Protocol)::DownCast(writer.ChangeWriter().WS()->Protocol()));
    std::ostringstream text;
    if (!lines.Print(text)) throw std::runtime_error("STEP: the sheet cannot be written");
    return std::move(text).str();
  }

 private:
  const Product& product_;
  Handle(TDocStd_Document) document_;
  std::vector<TopoDS_Shape> solids_;
};

}  // namespace
}  // namespace kinetix::app::cad

void kinetix_write_step(const kinetix::app::cad::Product& product, std::string& text) {
  using namespace kinetix::app::cad;
  Message::DefaultMessenger()->ChangePrinters().Clear();  // it would write to stdout
  text = Document(product).text();
}
