#include "fitting/least_squares/triangular_reduction.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "fitting/interruption.h"
#include "fitting/matrix_product.h"
#include "fitting/parallel_for.h"

// LAPACK 3.4: QR of a triangle on top of a pentagonal block, and its reflectors
// applied to further columns.
extern "C" {
void dtprfb_(const char* side,
             const char* transpose,
             const char* direction,
             const char* storage,
             const int* m,
             const int* n,
             const int* k,
             const int* l,
             const double* v,
             const int* ldv,
             const double* t,
             const int* ldt,
             double* a,
             const int* lda,
             double* b,
             const int* ldb,
             double* work,
             const int* ldwork,
             std::size_t side_length,
             std::size_t transpose_length,
             std::size_t direction_length,
             std::size_t storage_length);
void dtpqrt_(const int* m,
             const int* n,
             const int* l,
             const int* nb,
             double* a,
             const int* lda,
             double* b,
             const int* ldb,
             double* t,
             const int* ldt,
             double* work,
             int* info);
}

namespace errmap::fitting {
namespace {

void Require(bool holds, const std::string& what) {
  if (!holds) throw std::invalid_argument("ReduceToTriangle: " + what);
}

// Columns folded together; wider panels lose in the panel what they win in the
// products (measured over 16 to 64).
constexpr int kPanel = 48;

// QR of the triangle (n x n) on top of the block (m x n) in their place, the
// reflectors' factors of each panel in `reflectors`.
void FoldPanels(Eigen::Ref<MatrixXd> triangle,
                Eigen::Ref<MatrixXd> block,
                MatrixXd* reflectors) {
  const int rows = static_cast<int>(block.rows());
  const int columns = static_cast<int>(block.cols());
  const int panel = std::min(kPanel, columns);
  const int leading = static_cast<int>(triangle.outerStride());
  const int block_leading = static_cast<int>(block.outerStride());
  constexpr int kRectangular = 0;
  reflectors->resize(panel, columns);
  std::vector<double> work(static_cast<std::size_t>(panel) *
                           static_cast<std::size_t>(columns));
  int info = 0;
  UseOneThreadPerCall();
  dtpqrt_(&rows,
          &columns,
          &kRectangular,
          &panel,
          triangle.data(),
          &leading,
          block.data(),
          &block_leading,
          reflectors->data(),
          &panel,
          work.data(),
          &info);
  assert(info == 0);
}

// Applies the reflectors of a panel, its `rows` x `panel` block and triangle
// (panel x panel), to further columns.
void ApplyPanel(const Eigen::Ref<const MatrixXd>& panel,
                const MatrixXd& reflectors,
                Eigen::Ref<MatrixXd> triangle,
                Eigen::Ref<MatrixXd> block) {
  const int rows = static_cast<int>(block.rows());
  const int columns = static_cast<int>(block.cols());
  const int width = static_cast<int>(panel.cols());
  const int panel_leading = static_cast<int>(panel.outerStride());
  const int reflectors_leading = static_cast<int>(reflectors.outerStride());
  const int leading = static_cast<int>(triangle.outerStride());
  const int block_leading = static_cast<int>(block.outerStride());
  constexpr int kRectangular = 0;
  MatrixXd work(width, columns);
  dtprfb_("L",
          "T",
          "F",
          "C",
          &rows,
          &columns,
          &width,
          &kRectangular,
          panel.data(),
          &panel_leading,
          reflectors.data(),
          &reflectors_leading,
          triangle.data(),
          &leading,
          block.data(),
          &block_leading,
          work.data(),
          &width,
          1,
          1,
          1,
          1);
}

}  // namespace

void FoldIntoTriangle(MatrixXd* triangle, Eigen::Ref<MatrixXd> block) {
  const Index rows = block.rows();
  const Index columns = block.cols();
  if (rows == 0 || columns == 0) return;
  // Work longer than a tenth of a second is done in pieces of that length, the
  // same steps in the same order, so that it can be interrupted between them.
  constexpr double kMostProducts = 1e9;
  MatrixXd reflectors;
  const auto panel_products = [&](Index width) {
    return 2.0 * kPanel * static_cast<double>(rows) *
           static_cast<double>(width);
  };
  if (panel_products(columns) * static_cast<double>(columns) <=
      kPanel * kMostProducts) {
    FoldPanels(*triangle, block, &reflectors);
    return;
  }
  const Index piece = std::max<Index>(
      kPanel, static_cast<Index>(kMostProducts / panel_products(1)));
  for (Index first = 0; first < columns; first += kPanel) {
    const Index width = std::min<Index>(kPanel, columns - first);
    ThrowIfInterrupted();
    FoldPanels(triangle->block(first, first, width, width),
               block.middleCols(first, width),
               &reflectors);
    for (Index next = first + width; next < columns; next += piece) {
      const Index count = std::min(piece, columns - next);
      ThrowIfInterrupted();
      ApplyPanel(block.middleCols(first, width),
                 reflectors,
                 triangle->block(first, next, width, count),
                 block.middleCols(next, count));
    }
  }
}

MatrixXd ReduceToTriangle(Index rows,
                          Index columns,
                          const FillRows& fill,
                          const ReductionOptions& options) {
  Require(
      rows >= 0 && columns >= 1,
      "a matrix of " + std::to_string(rows) + " x " + std::to_string(columns));
  Require(
      options.block_rows >= 1 && options.chains >= 1 && options.threads >= 1,
      "block_rows, chains and threads must be at least 1");
  const Index blocks = (rows + options.block_rows - 1) / options.block_rows;
  const Index chains = std::clamp<Index>(blocks, 1, options.chains);
  std::vector<MatrixXd> triangles(static_cast<std::size_t>(chains),
                                  MatrixXd::Zero(columns, columns));
  ParallelFor(options.threads, chains, [&](Index chain) {
    MatrixXd block(options.block_rows, columns);
    const Index end = (chain + 1) * blocks / chains;
    for (Index b = chain * blocks / chains; b < end; ++b) {
      const Index first = b * options.block_rows;
      const Index count = std::min(options.block_rows, rows - first);
      fill(first, block.topRows(count));
      FoldIntoTriangle(&triangles[static_cast<std::size_t>(chain)],
                       block.topRows(count));
    }
  });
  for (std::size_t apart = 1; apart < triangles.size(); apart *= 2) {
    for (std::size_t i = 0; i + apart < triangles.size(); i += 2 * apart) {
      FoldIntoTriangle(&triangles[i], triangles[i + apart]);
      triangles[i + apart].resize(0, 0);
    }
  }
  // Entries below the diagonal were never touched.
  return triangles[0];
}

}  // namespace errmap::fitting
