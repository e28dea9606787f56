#include <set>
#include <stdexcept>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/column_header.h"
#include "models/export/program/safe_names.h"
#include "models/export/program_text.h"
#include "models/polynomial/polynomial_model.h"

namespace errmap::models {
namespace {

using ::testing::HasSubstr;

// A linear map of these columns, all trained in 0 to 10.
MapExport MapOf(const std::vector<std::string>& columns,
                const std::string& target = "error_um") {
  const auto count = static_cast<Eigen::Index>(columns.size());
  PolynomialForm form;
  form.input_offset = Eigen::VectorXd::Zero(count);
  form.input_scale = Eigen::VectorXd::Ones(count);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    PolynomialTerm term{std::vector<int>(columns.size(), 0), 0.1};
    term.powers[i] = 1;
    form.terms.push_back(term);
  }
  FittedModel fitted;
  fitted.name = "made";
  fitted.target = {target, data::UnitOfColumn(target)};
  for (const std::string& name : columns) {
    fitted.inputs.push_back(
        {{name, data::UnitOfColumn(name)}, 0.0, 10.0, 5.0, 3.0});
  }
  fitted.model = std::make_shared<PolynomialModel>(form, count + 1);
  return PrepareExport({&fitted}, "a_map_of_a_long_name", Precision::kDouble);
}

const HalOptions kMillimetres{.unit = data::UnitOfSymbol("mm"), .joint = 2};

TEST(HalComponent, KeepsPinNamesWithinHalAndApart) {
  std::vector<std::string> columns{"position_mm"};
  for (int i = 0; i < 60; ++i) {
    columns.push_back(fmt::format(
        "temperature of the headstock near bearing number {} [degC]", i));
  }
  const HalExport made = HalComponent(MapOf(columns), kMillimetres);
  std::set<std::string> pins;
  for (const HalPin& pin : made.pins) {
    EXPECT_LE(made.component.size() + 1 + pin.pin.size(), kLongestHalName);
    EXPECT_TRUE(pins.insert(pin.pin).second) << pin.pin;
  }
  EXPECT_EQ(made.pins.front().pin, "position");
  ASSERT_EQ(made.files.size(), 4);
  // The wiring lists the columns behind the pins.
  EXPECT_THAT(
      made.files[0].content,
      HasSubstr(made.pins.back().pin + " # " + CommentText(columns.back())));
}

TEST(HalComponent, WiresTheJointAndItsAxis) {
  const HalExport made =
      HalComponent(MapOf({"position_mm", "t1_degC"}), kMillimetres);
  // Last, since the files before it name the export that they load.
  EXPECT_EQ(made.files[3].name, "errmap_a_map_of_a_long.comp");
  EXPECT_THAT(made.files[0].content,
              HasSubstr("joint.2.motor-pos-cmd => errmap-a-map-of-a-long-add"));
  EXPECT_THAT(made.files[1].content, HasSubstr("axis.z.eoffset-counts"));
  EXPECT_THAT(made.files[1].content, HasSubstr("[AXIS_Z]:  OFFSET_AV_RATIO"));
}

TEST(HalComponent, TurnsTheErrorIntoTheMachinesUnit) {
  EXPECT_THAT(
      HalComponent(MapOf({"position_mm"}), kMillimetres).files[3].content,
      HasSubstr("offset = -0.001 * error;"));
  const HalOptions inches{.unit = data::UnitOfSymbol("in")};
  EXPECT_THAT(HalComponent(MapOf({"position_mm"}), inches).files[3].content,
              HasSubstr("x[0] = position * 25.4;"));
}

TEST(HalComponent, RefusesAnErrorThatIsNoLength) {
  EXPECT_THROW(HalComponent(MapOf({"position_mm"}, "error_urad"), kMillimetres),
               std::invalid_argument);
}

}  // namespace
}  // namespace errmap::models
