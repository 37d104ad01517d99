#include "tests/app/print/step_judge.hpp"

#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <GProp_GProps.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPControl_Reader.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_Shape.hxx>

namespace kinetix::testing {

StepVerdict read_step(const std::string& file) {
  Message::DefaultMessenger()->ChangePrinters().Clear();
  StepVerdict verdict;
  STEPControl_Reader reader;
  if (reader.ReadFile(file.c_str()) != IFSelect_RetDone) return verdict;
  reader.TransferRoots();
  const TopoDS_Shape shape = reader.OneShape();
  verdict.valid = BRepCheck_Analyzer(shape).IsValid();
  for (TopExp_Explorer solids(shape, TopAbs_SOLID); solids.More(); solids.Next()) {
    GProp_GProps properties;
    BRepGProp::VolumeProperties(solids.Current(), properties);
    verdict.volume_mm3 += properties.Mass();
    ++verdict.solids;
  }
  return verdict;
}

}  // namespace kinetix::testing
