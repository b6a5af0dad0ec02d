#include <fmt/format.h>
#include <gtest/gtest.h>

#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <IGESControl_Writer.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Writer.hxx>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <gp_Trsf.hxx>
#include <iterator>
#include <optional>

#include "oracle.hpp"
#include "simulation/cad_solid.hpp"
#include "simulation/solid_recipe.hpp"
#include "worlds_of_faces.hpp"

/// Random ways on every kind of surface, each contact judged by the oracle. PROBEWRIGHT_CAMPAIGN=100 asks for a hundred
/// times as many worlds, PROBEWRIGHT_CAMPAIGN_FROM=7 for others.
namespace probewright::simulation {
namespace {

using namespace testing;

std::uint64_t seed(int usual) { return static_cast<std::uint64_t>(usual + campaignStart()); }

void judge(const NamedShape& named, std::mt19937_64& random, int ways) {
  const auto solid = cadSolid(named.shape);
  ASSERT_TRUE(solid) << named.name << ": " << format(solid.error());
  // As it was prepared: OpenCASCADE tessellates some surfaces with kinks for hours.
  const auto& prepared = dynamic_cast<const CadSolid&>(**solid);
  EXPECT_GT(expectTrueContacts(named.name, prepared.shape(), prepared, random, ways), ways / 10) << named.name;
}

TEST(ContactOracle, FacesInAnyRangeOfTheirParametersAreMetWhereTheyAre) {
  std::mt19937_64 random(seed(101));
  for (int i = 0; i < campaignFactor(); ++i) {
    for (const NamedShape& face : singleFaces(random))
      judge(face, random, waysInCampaign(40));
  }
}

TEST(ContactOracle, BodiesAreMetWhateverOtherSystemsMakeOfThem) {
  std::mt19937_64 random(seed(102));
  for (int i = 0; i < campaignFactor(); ++i) {
    const std::vector<NamedShape> all = bodies(random);
    for (std::size_t k = 0; k < all.size(); ++k) {
      // One after the other here, all in a campaign.
      for (std::size_t how = 0; how < kDisguises; ++how) {
        if (campaignFactor() > 1 || how == k % kDisguises)
          judge(disguised(all[k], how, random), random, waysInCampaign(40));
      }
    }
  }
}

/// Parts of a few tenths of a millimetre, as files in a wrong unit give: triangles that are fine for a usual part are
/// coarse for these and their balls.
TEST(ContactOracle, TinyPartsAreMetWhereTheyAre) {
  std::mt19937_64 random(seed(106));
  gp_Trsf smaller;
  smaller.SetScaleFactor(0.01);
  for (int i = 0; i < campaignFactor(); ++i) {
    std::vector<NamedShape> all = singleFaces(random);
    std::ranges::move(bodies(random), std::back_inserter(all));
    for (const NamedShape& named : all)
      judge({"tiny " + named.name, BRepBuilderAPI_Transform(named.shape, smaller, true).Shape()}, random,
            waysInCampaign(40));
  }
}

/// A file of a format and unit, read back.
Result<std::unique_ptr<Solid>> throughFile(const TopoDS_Shape& shape, const std::string& schema,
                                           const std::string& unit, const ScratchFolder& folder) {
  if (schema.starts_with("IGES")) {
    IGESControl_Writer writer(unit.c_str(), schema == "IGES bodies" ? 1 : 0);
    writer.AddShape(shape);
    writer.ComputeModel();
    if (!writer.Write((folder / "part.igs").c_str())) return fail("not written");
    return readIges(folder / "part.igs");
  }
  Message::DefaultMessenger()->ChangePrinters().Clear();
  STEPControl_Controller::Init();
  Interface_Static::SetCVal("write.step.schema", schema.c_str());
  Interface_Static::SetCVal("write.step.unit", unit.c_str());
  STEPControl_Writer writer;
  writer.Transfer(shape, STEPControl_AsIs);
  writer.Write((folder / "part.step").c_str());
  Interface_Static::SetCVal("write.step.schema", "AP214IS");
  Interface_Static::SetCVal("write.step.unit", "MM");
  return readStep(folder / "part.step");
}

/// mm; nothing of the few shapes whose box OpenCASCADE cannot find.
std::optional<double> exactSize(const TopoDS_Shape& shape) {
  try {
    Bnd_Box box;
    BRepBndLib::AddOptimal(shape, box, Standard_False, Standard_False);
    return box.CornerMin().Distance(box.CornerMax());
  } catch (const Standard_Failure&) {
    return std::nullopt;
  }
}

TEST(ContactOracle, FilesOfAnyFormatAndUnitAreMetWhereTheirShapesAre) {
  std::mt19937_64 random(seed(103));
  const std::vector<std::pair<std::string, std::string>> formats{
      {"AP203", "MM"},      {"AP203", "INCH"},  {"AP214IS", "CM"},    {"AP214IS", "INCH"},
      {"AP242DIS", "INCH"}, {"AP242DIS", "MM"}, {"IGES faces", "MM"}, {"IGES bodies", "INCH"}};
  const ScratchFolder folder;
  for (int i = 0; i < campaignFactor(); ++i) {
    const std::vector<NamedShape> all = bodies(random);
    for (std::size_t k = 0; k < all.size(); ++k) {
      for (std::size_t j = 0; j < formats.size(); ++j) {
        if (campaignFactor() == 1 && 2 * j != k) continue;
        const auto& [schema, unit] = formats[j];
        const NamedShape written = disguised(all[k], random() % kDisguises, random);
        const std::string name = written.name + " through " + schema + " in " + unit;
        const auto solid = throughFile(written.shape, schema, unit, folder);
        // OpenCASCADE writes a torus without edges, joined of pieces, as nothing.
        if (!solid && written.name == "torus, split and joined") continue;
        ASSERT_TRUE(solid) << name << ": " << format(solid.error());
        // The reader mends shapes; what it made of them is judged, and that it is about the same.
        const auto& read = dynamic_cast<const CadSolid&>(**solid);
        const double readSize = (read.bounds().maximum - read.bounds().minimum).norm();
        if (const auto size = exactSize(written.shape)) {
          // The box counts turned faces whole, beyond their borders.
          EXPECT_LT(readSize, 1.05 * *size) << name;
          EXPECT_GT(readSize, 0.8 * *size) << name;
        }
        EXPECT_GT(expectTrueContacts(name, read.shape(), read, random, waysInCampaign(40)), 4) << name;
      }
    }
  }
}

/// PROBEWRIGHT_PARTS=FOLDER: the STEP and IGES files in that folder.
TEST(ContactOracle, PartsOfAFolderAreMetWhereTheyAre) {
  const char* folder = std::getenv("PROBEWRIGHT_PARTS");
  if (folder == nullptr) GTEST_SKIP() << "set PROBEWRIGHT_PARTS to a folder with STEP and IGES files";
  std::mt19937_64 random(105);
  int judged = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string ending = entry.path().extension().string();
    const bool iges = ending == ".igs" || ending == ".iges";
    if (!iges && ending != ".stp" && ending != ".step") continue;
    const auto solid = iges ? readIges(entry.path()) : readStep(entry.path());
    if (!solid) continue;  // not every file holds faces
    const auto& read = dynamic_cast<const CadSolid&>(**solid);
    expectTrueContacts(entry.path().filename().string(), read.shape(), read, random, 60 * campaignFactor());
    ++judged;
  }
  EXPECT_GT(judged, 0);
}

SolidFeature randomFeature(std::mt19937_64& random, FeatureShape shape) {
  SolidFeature f;
  f.shape = shape;
  f.diameter = uniform(random, 6, 30);
  f.height = uniform(random, 5, 30);
  f.size = {uniform(random, 15, 50), uniform(random, 10, 15), uniform(random, 5, 30)};
  switch (random() % 3) {
    case 0:
      f.cornerRadius = 0;
      break;
    case 1:
      f.cornerRadius = f.size.y() / 2;
      break;
    default:
      f.cornerRadius = uniform(random, 1, 4);
  }
  f.topDiameter = random() % 2 == 0 ? 0 : uniform(random, 0.1, 0.9) * f.diameter;
  f.tubeDiameter = uniform(random, 0.1, 0.8) * f.diameter;
  f.depth = random() % 3 == 0 ? 0 : uniform(random, 2, 12);
  f.rotation = {random() % 2 == 0 ? 0 : uniform(random, -40, 40), random() % 2 == 0 ? 0 : uniform(random, -40, 40),
                uniform(random, -180, 180)};
  f.centre = {uniform(random, -20, 20), uniform(random, -15, 15), random() % 2 == 0 ? 0 : uniform(random, -6, 6)};
  f.mode = random() % 2 == 0 ? FeatureMode::Add : FeatureMode::Cut;
  if (random() % 3 == 0) {
    FeaturePattern pattern;
    pattern.kind = random() % 2 == 0 ? FeaturePattern::Kind::Linear : FeaturePattern::Kind::Circular;
    pattern.count = 2 + static_cast<int>(random() % 3);
    pattern.spacing = {uniform(random, 8, 25), uniform(random, -10, 10), 0};
    f.patterns = {pattern};
  }
  return f;
}

TEST(ContactOracle, PartsOfAllFeaturesAreMetWhereTheyAre) {
  std::mt19937_64 random(seed(104));
  constexpr std::array kShapes{FeatureShape::Box,   FeatureShape::Cylinder, FeatureShape::Cone,   FeatureShape::Sphere,
                               FeatureShape::Torus, FeatureShape::Hole,     FeatureShape::Pocket, FeatureShape::Slot};
  int parts = 0;
  for (std::size_t i = 0; i < 24 * static_cast<std::size_t>(campaignFactor()); ++i) {
    SolidFeature base;
    base.size = {80, 60, 25};
    base.centre.z() = -25;
    SolidRecipe recipe{{base, randomFeature(random, kShapes[i % kShapes.size()])}};
    if (random() % 2 == 0) recipe.features.push_back(randomFeature(random, kShapes[random() % kShapes.size()]));
    if (random() % 3 == 0) {
      SolidFeature edge;
      edge.shape = random() % 2 == 0 ? FeatureShape::Fillet : FeatureShape::Chamfer;
      edge.edgeSize = uniform(random, 0.5, 2);
      edge.edges = {{40, 30, -15}, {-40, -30, -15}};
      recipe.features.push_back(edge);
    }
    const auto shape = buildShape(recipe);
    if (!shape) continue;
    ++parts;
    std::string name = fmt::format("part {}", i);
    for (const SolidFeature& f : recipe.features)
      name += fmt::format(" {}{}", f.mode == FeatureMode::Cut ? "-" : "+", nameOf(f.shape));
    judge({name, *shape}, random, waysInCampaign(60));
  }
  EXPECT_GT(parts, 15 * campaignFactor());
}

/// The probe goes from the middle of a slot to its round ends and from the middle of a pocket to its round sides.
TEST(SlotsAndPockets, HaveWallsAtBothTheirEnds) {
  for (const double turn : {0.0, 20.0, 90.0, 180.0, -135.0}) {
    for (const bool slot : {true, false}) {
      SolidFeature block;
      block.size = {70, 70, 30};
      SolidFeature cut;
      cut.shape = slot ? FeatureShape::Slot : FeatureShape::Pocket;
      cut.centre = {1, 2, 30};
      cut.rotation = {0, 0, turn};
      cut.size = {44, 18, 0};
      cut.cornerRadius = 9;
      cut.depth = 11;
      const auto part = buildSolid({{block, cut}});
      ASSERT_TRUE(part) << format(part.error());
      const Pose pose = translation({1, 2, 22}) * rotation(Vector3::UnitZ(), turn);
      for (int degrees = 0; degrees < 360; degrees += 15) {
        const Vector3 out = rotation(Vector3::UnitZ(), degrees) * Vector3::UnitX();
        const Vector3 from(out.x() < -1e-9 ? -13 : 13, 0, 0);
        const auto contact = (*part)->firstContact(pose * from, pose * (from + 30 * out), 1.5);
        ASSERT_TRUE(contact) << degrees;
        EXPECT_NEAR(contact->fraction * 30, 7.5, 1e-9) << degrees << " degrees, turned by " << turn;
      }
    }
  }
}

TEST(SlotsAndPockets, BoxesAsRoundAsTheyAreWideHaveRoundEnds) {
  SolidFeature box;
  box.size = {60, 50, 30};
  box.cornerRadius = 25;
  const auto part = buildSolid({{box}});
  ASSERT_TRUE(part) << format(part.error());
  for (int degrees = 10; degrees < 360; degrees += 20) {
    const Vector3 out = rotation(Vector3::UnitZ(), degrees) * Vector3::UnitX();
    const Vector3 centre(out.x() < 0 ? -5 : 5, 0, 20);
    const auto contact = (*part)->firstContact(centre + 45 * out, centre, 2);
    ASSERT_TRUE(contact) << degrees;
    EXPECT_NEAR(contact->fraction * 45, 45 - 27, 1e-9) << degrees;
  }
}

/// A vertex may lie off the ends of its edges, within its tolerance: the ends are what is touched. OpenCASCADE's
/// distances know the vertex only, and the oracle must not take that for an error of the contact, nor miss an error.
TEST(LooseVertices, BallsMeetTheEndsOfTheEdges) {
  for (const double off : {-0.002, 0.002}) {
    const TopoDS_Shape box = BRepPrimAPI_MakeBox(10, 10, 10).Shape();
    const gp_Pnt corner(10, 10, 10);
    for (TopExp_Explorer found(box, TopAbs_VERTEX); found.More(); found.Next()) {
      const TopoDS_Vertex& vertex = TopoDS::Vertex(found.Current());
      if (BRep_Tool::Pnt(vertex).Distance(corner) < 0.1)
        BRep_Builder().UpdateVertex(vertex, corner.Translated(gp_Vec(off, off, off)), 0.004);
    }
    const auto solid = cadSolid(box);
    ASSERT_TRUE(solid) << format(solid.error());
    const Oracle oracle(box);
    const Vector3 end(10, 10, 10);
    for (const Vector3& out : {Vector3(1, 1, 1), Vector3(1, 2, 1.5), Vector3(2, 0.5, 1)}) {
      const Vector3 from = end + 20 * out.normalized(), to = end - out;
      auto contact = (*solid)->firstContact(from, to, 3);
      ASSERT_TRUE(contact) << off;
      EXPECT_NEAR(contact->fraction * (to - from).norm(), 17, 1e-9) << off;
      EXPECT_EQ(oracle.objectionTo(contact, from, to, 3, true), "") << off;
      // Wrong by more than the vertex, to either side.
      for (const double wrong : {-0.006, 0.006}) {
        BallContact moved = *contact;
        moved.fraction += wrong / (to - from).norm();
        moved.ballCentre = from + moved.fraction * (to - from);
        EXPECT_NE(oracle.objectionTo(moved, from, to, 3, true), "") << off << " " << wrong;
      }
    }
  }
}

/// The washer's bead in closed form: from above the ball stands on a torus of tube 1.2 and ring 20.8.
TEST(BeadWasher, IsTouchedOnItsBeadAllAround) {
  const auto washer = cadSolid(beadWasher());
  ASSERT_TRUE(washer) << format(washer.error());
  const double radius = 0.7;
  for (int degrees = 0; degrees < 360; degrees += 7) {
    for (const double rho : {19.9, 20.3, 20.8, 21.4, 21.9}) {
      const Vector3 place = rotation(Vector3::UnitZ(), degrees) * Vector3(rho, 0, 0);
      const auto contact = (*washer)->firstContact(place + Vector3(0, 0, 40), place, radius);
      ASSERT_TRUE(contact) << degrees << " " << rho;
      EXPECT_NEAR(contact->ballCentre.z(), 5 + std::sqrt(std::pow(1.2 + radius, 2) - std::pow(rho - 20.8, 2)), 1e-6)
          << degrees << " " << rho;
    }
    const Vector3 free = rotation(Vector3::UnitZ(), degrees) * Vector3(5, 0, 0);
    EXPECT_FALSE((*washer)->firstContact(free + Vector3(0, 0, 40), free - Vector3(0, 0, 40), radius));
  }
}

}  // namespace
}  // namespace probewright::simulation
