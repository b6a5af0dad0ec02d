#pragma once

#include <Eigen/Core>

/// QR factors of what fits have many types of, compiled once: Eigen's HouseholderQR takes ten seconds of compiling for
/// each type of matrix. The numbers are the same.
namespace probewright::metrology {

/// Any number of rows, at most 7 columns, which Eigen multiplies in the order that it has for small matrices.
using FewColumns = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, Eigen::Dynamic, 7>;

/// Factors `matrix` (at least as many rows as columns) in place: R is its upper triangle afterwards, what lies below it
/// has no use any more. `right`, of as many rows or none, becomes Q^T `right`.
void triangularize(Eigen::Ref<FewColumns> matrix, Eigen::Ref<Eigen::VectorXd> right);

/// The x with R x = `right` in place of `right`; R is the upper triangle of `matrix`, which is square.
void substituteBack(const Eigen::Ref<const FewColumns>& matrix, Eigen::Ref<Eigen::VectorXd> right);

}  // namespace probewright::metrology
