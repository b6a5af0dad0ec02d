#include <gtest/gtest.h>

#include "simulation/step_text.hpp"

/// Numbers of STEP files as OpenCASCADE reads them.
namespace probewright::simulation {
namespace {

/// Exponents become capital wherever numbers stand, and nothing else: not in texts, not in names.
TEST(StepNumbers, HaveCapitalExponents) {
  const std::pair<const char*, const char*> texts[] = {
      {"#1=P('1e2',1e2);", "#1=P('1e2',1E2);"},
      {"#1=P('',(1.e-3,-2.5e+4,.5e6));", "#1=P('',(1.E-3,-2.5E+4,.5E6));"},
      {"#1=P('it''s 3e4',5e6,'7e8');", "#1=P('it''s 3e4',5E6,'7e8');"},
      {"#1=P('it's 3e4',5e6,'7e8');", "#1=P('it's 3e4',5E6,'7e8');"},
      {"/* it's */ #1=P(5e6,'7e8');", "/* it's */ #1=P(5E6,'7e8');"},
      {"#22=P(1e5);#333=P(.true.,1e5);", "#22=P(1E5);#333=P(.true.,1E5);"},
      {"#1=pe('e1',$,2.0);", "#1=pe('e1',$,2.0);"},
      {"1e1", "1E1"},
      {"e1", "e1"},
      {"1e", "1e"}};
  for (const auto& [text, expected] : texts)
    EXPECT_EQ(withCapitalExponents(text), expected);
}

}  // namespace
}  // namespace probewright::simulation
