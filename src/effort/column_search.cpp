// SPDX-License-Identifier: MIT
#include "effort/column_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <strut/core/error.h>

namespace strut::effort::detail {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Rows of numbers per column of a block, evenly apart, each with a tile's worth before its first.
template <typename T>
class Rows {
 public:
  void reset(int rows, int width, T before) {
    stride_ = kTileColumns + width;
    numbers_.assign(static_cast<std::size_t>(rows) * static_cast<std::size_t>(stride_), before);
  }
  T* row(int index) { return numbers_.data() + kTileColumns + stride_ * index; }
  [[nodiscard]] std::ptrdiff_t stride() const { return stride_; }

 private:
  math::AlignedVector<T> numbers_;
  std::ptrdiff_t stride_ = 0;
};

/// What a thread works in.
struct Workspace {
  Rows<float> distances;  // of the query frame before a group of kQueryRows, then of the group
  Rows<float> costs;      // of a query frame and of the two before, in turn
  Rows<std::int32_t> traces;

  void reset(int width) {
    distances.reset(kQueryRows + 1, width, 0.0F);
    costs.reset(3, width, kInfinity);
    traces.reset(3, width, 0);
  }
  CellRow cells(int frame) { return {costs.row(frame % 3), traces.row(frame % 3)}; }
};

/// Columns [begin, end) whose ends are wanted, and where the work begins: at a tile, before everything that a match
/// can cover.
struct Block {
  int from, begin, end;
  [[nodiscard]] int width() const { return math::padded(end - from, kTileColumns); }
};

void begin_matches(int width, const float* distance, const float* start, const CellRow& cells) {
  for (int j = 0; j < width; ++j) cells.cost[j] = distance[j] + distance[j];
  // `start` ends with the index's columns, and nothing begins in those that fill the last tile up: they are infinite.
  if (start != nullptr) {
    for (int j = 0; j < width; ++j) cells.cost[j] += start[j];
  }
  std::fill_n(cells.trace, width, 1);
}

/// Leaves the last query frame's cells in the workspace, counted from block.from.
void search_block(const SearchKernels& kernels, const SearchQuery& query, const SearchIndex& index, const Block& block,
                  const float* start, Workspace& work) {
  const int width = block.width(), dims = index.dimensions();
  work.reset(width);
  const float* columns = index.tiles().data() + static_cast<std::ptrdiff_t>(block.from) * dims;
  for (int i = 0; i < query.num_frames(); ++i) {
    const int r = i % kQueryRows;
    if (r == 0) {
      std::copy_n(work.distances.row(kQueryRows), width, work.distances.row(0));
      kernels.distances(dims, width / kTileColumns, query.row(i), columns, work.distances.row(1),
                        work.distances.stride());
    }
    if (i == 0) {
      begin_matches(width, work.distances.row(1), start == nullptr ? nullptr : start + block.from, work.cells(0));
    } else {
      kernels.step(width, work.distances.row(r + 1), work.distances.row(r), work.cells(i - 1), work.cells(i + 1),
                   work.cells(i));
    }
  }
}

}  // namespace

SearchQuery::SearchQuery(const Eigen::Ref<const FrameMatrix>& query, int dimensions)
    : num_frames_(static_cast<int>(std::min<Eigen::Index>(query.rows(), kMostQueryFrames + 1))),
      dimensions_(dimensions) {
  if (num_frames_ == 0) throw InvalidArgument("query", "at least one frame", "none");
  if (num_frames_ > kMostQueryFrames) {
    throw InvalidArgument("query", "at most " + std::to_string(kMostQueryFrames) + " frames",
                          std::to_string(query.rows()));
  }
  if (query.cols() != dimensions) {
    throw InvalidArgument("query", std::to_string(dimensions) + " columns", std::to_string(query.cols()));
  }
  const Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> narrow = query.cast<float>();
  if (!narrow.allFinite()) throw InvalidArgument("query", "finite numbers", "one that is not");
  numbers_.assign(static_cast<std::size_t>(math::padded(num_frames_, kQueryRows) * dimensions), 0.0F);
  std::copy_n(narrow.data(), narrow.size(), numbers_.begin());
}

EndCells search_columns(const SearchKernels& kernels, const SearchQuery& query, const SearchIndex& index, int first,
                        int last, const float* start, int block) {
  const auto count = static_cast<std::size_t>(last - first);
  EndCells ends{std::vector<float>(count), std::vector<std::int32_t>(count)};
  const int before = 2 * (query.num_frames() - 1);  // a match covers at most one column more
  const int size = std::max(block, 2 * before);     // or the work before blocks would outweigh their own
  const int num_blocks = (last - first + size - 1) / size;
  tbb::enumerable_thread_specific<Workspace> workspaces;
  tbb::parallel_for(0, num_blocks, [&](int b) {
    Block here{0, first + b * size, 0};
    here.end = std::min(last - here.begin, size) + here.begin;
    here.from = std::max(0, here.begin - before) / kTileColumns * kTileColumns;
    Workspace& work = workspaces.local();
    search_block(kernels, query, index, here, start, work);
    const CellRow cells = work.cells(query.num_frames() - 1);
    std::copy(cells.cost + (here.begin - here.from), cells.cost + (here.end - here.from),
              ends.cost.begin() + (here.begin - first));
    std::copy(cells.trace + (here.begin - here.from), cells.trace + (here.end - here.from),
              ends.trace.begin() + (here.begin - first));
  });
  return ends;
}

}  // namespace strut::effort::detail
