#pragma once

#include <functional>

#include "stats/eigen.h"

namespace errmap::fitting {

/// Fills `block` (b x n) with rows first .. first + block.rows() - 1 of a tall
/// matrix. Called from several threads at once.
using FillRows = std::function<void(Index first, Eigen::Ref<MatrixXd> block)>;

struct ReductionOptions {
  Index block_rows = 2048;  // rows held per thread at a time; at least 1
  /// Number of chains of blocks, whose triangles are combined in pairs at the
  /// end. It affects rounding; the number of threads does not. At least 1.
  Index chains = 4;
  int threads = 1;  // at least 1; changes no bit of the result
};

/// Returns R (n x n) of the QR decomposition of a matrix (m x n) that is never
/// held in memory. Blocks of rows are folded into one triangle per chain, and
/// these are combined in pairs (a TSQR tree: Demmel, Grigori, Hoemmen and
/// Langou 2012). R'R = A'A to rounding, without forming A'A. One pass; memory
/// for chains x n^2 and threads x block_rows x n numbers.
///
/// Throws std::invalid_argument if rows < 0, columns < 1 or an option is bad.
MatrixXd ReduceToTriangle(Index rows,
                          Index columns,
                          const FillRows& fill,
                          const ReductionOptions& options = {});

/// Folds the rows of `block` (b x n, destroyed) into the triangle (n x n).
void FoldIntoTriangle(MatrixXd* triangle, Eigen::Ref<MatrixXd> block);

}  // namespace errmap::fitting
