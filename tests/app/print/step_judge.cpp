#include "tests/app/print/step_judge.hpp"

#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Quantity_Color.hxx>
#include <STEPCAFControl_Reader.hxx>
#include <TDF_LabelSequence.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_Shape.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>

namespace kinetix::testing {
namespace {

std::string first_word(const TDF_Label& label) {
  Handle(TDataStd_Name) name;
  if (!label.FindAttribute(TDataStd_Name::GetID(), name)) return "";
  const TCollection_AsciiString text(name->Get());
  return std::string(text.ToCString()).substr(0, std::string(text.ToCString()).find(' '));
}

std::string colour_of(const Handle(XCAFDoc_ColorTool) & colours, const TDF_Label& shape) {
  Quantity_Color colour;
  if (!colours->GetColor(shape, XCAFDoc_ColorSurf, colour)) return "none";
  return Quantity_Color::ColorToHex(colour).ToCString();
}

void count_names(const Handle(TDocStd_Document) & document, StepVerdict& verdict) {
  const Handle(XCAFDoc_ShapeTool) shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
  const Handle(XCAFDoc_ColorTool) colours = XCAFDoc_DocumentTool::ColorTool(document->Main());
  TDF_LabelSequence roots, parts;
  shapes->GetFreeShapes(roots);
  for (const TDF_Label& root : roots) XCAFDoc_ShapeTool::GetComponents(root, parts);
  for (const TDF_Label& part : parts) {
    TDF_Label shape;
    XCAFDoc_ShapeTool::GetReferredShape(part, shape);
    ++verdict.names[first_word(part)];
    ++verdict.colours[colour_of(colours, shape)];
  }
}

void judge(const TopoDS_Shape& shape, StepVerdict& verdict) {
  verdict.valid = BRepCheck_Analyzer(shape).IsValid();
  for (TopExp_Explorer solids(shape, TopAbs_SOLID); solids.More(); solids.Next()) {
    GProp_GProps properties;
    BRepGProp::VolumeProperties(solids.Current(), properties);
    verdict.volume_mm3 += properties.Mass();
    ++verdict.solids;
  }
  for (TopExp_Explorer shells(shape, TopAbs_SHELL); shells.More(); shells.Next()) {
    ++verdict.shells;
    verdict.open_shells += !BRep_Tool::IsClosed(shells.Current());
  }
}

}  // namespace

StepVerdict read_step(const std::string& file) {
  Message::DefaultMessenger()->ChangePrinters().Clear();
  StepVerdict verdict;
  Handle(TDocStd_Document) document;
  XCAFApp_Application::GetApplication()->NewDocument("MDTV-XCAF", document);
  STEPCAFControl_Reader reader;
  if (reader.ReadFile(file.c_str()) == IFSelect_RetDone && reader.Transfer(document)) {
    judge(reader.Reader().OneShape(), verdict);
    count_names(document, verdict);
  }
  XCAFApp_Application::GetApplication()->Close(document);
  return verdict;
}

}  // namespace kinetix::testing
