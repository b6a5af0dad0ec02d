#include "metrology/householder.hpp"

#include <Eigen/Householder>

namespace probewright::metrology {

void triangularize(Eigen::Ref<FewColumns> matrix, Eigen::Ref<Eigen::VectorXd> right) {
  const Eigen::Index columns = matrix.cols();
  Eigen::VectorXd workspace(columns);
  for (Eigen::Index k = 0; k < columns; ++k) {
    const Eigen::Index rows = matrix.rows() - k;
    double factor = 0, diagonal = 0;
    matrix.col(k).tail(rows).makeHouseholderInPlace(factor, diagonal);
    matrix(k, k) = diagonal;
    const auto reflection = matrix.col(k).tail(rows - 1);
    matrix.bottomRightCorner(rows, columns - k - 1).applyHouseholderOnTheLeft(reflection, factor, workspace.data());
    if (right.size() > 0) {
      right.bottomRightCorner(rows, right.cols()).applyHouseholderOnTheLeft(reflection, factor, workspace.data());
    }
  }
}

void substituteBack(const Eigen::Ref<const FewColumns>& matrix, Eigen::Ref<Eigen::VectorXd> right) {
  matrix.triangularView<Eigen::Upper>().solveInPlace(right);
}

}  // namespace probewright::metrology
