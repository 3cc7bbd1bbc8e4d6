// Kernels for dense matrices of T = double or float, stored column by column, whose columns are `stride` apart. They
// beat a BLAS for the sizes of most supernodes, tens of rows and columns, because they copy nothing and scatter
// products to the rows where they belong; for large ones they are about as fast. The order of operations depends on
// nothing but the sizes.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <vector>

namespace orthodyn {

template <class T>
class DenseBlocks {
#if defined(__AVX512F__)
  static constexpr int kBytes = 64;
#elif defined(__AVX__)
  static constexpr int kBytes = 32;
#else
  static constexpr int kBytes = 16;
#endif
  using Pack [[gnu::vector_size(kBytes)]] = T;
  static constexpr int kLanes = kBytes / static_cast<int>(sizeof(T));

 public:
  // Kernels read so many entries beyond the last one of a matrix, and do not use them.
  static constexpr int kPadding = 32;

  // A product's target: the entry (i, j) of the product is subtracted from to[rows[i] + stride * columns[j]].
  struct Target {
    T* to;
    std::size_t stride;
    const int *rows, *columns;
  };

  // Subtracts the lower trapezoid (i >= j) of A B^T from the target. A is m x k, and B has its first n rows. Entries of
  // the upper triangle may be subtracted, too.
  void subtract_product(int m, int n, int k, const T* a, std::size_t stride, const Target& target) {
    if (n >= kLargeColumns && k >= kLargeDepth) return subtract_large_product(m, n, k, a, stride, target);
    for (int j = 0; j < n; j += kTileColumns) {
      const int columns = std::min(kTileColumns, n - j);
      const T *rows = a + j, *b = a + j;
      for (int i = j; i < m; i += kTileRows, rows += kTileRows)
        subtract_tile(std::min(kTileRows, m - i), columns, k, rows, stride, b, stride, target, i, j);
    }
  }

  // Computes the first n columns of the Cholesky factor of a symmetric m x m matrix. `a` has the lower trapezoid of
  // the matrix's first n columns, and gets the trapezoid of the factor. Returns false if a pivot is not positive.
  bool factor(int m, int n, T* a, std::size_t stride) {
    reserve_identity(m);
    for (int j = 0; j < n; j += kPanelColumns) {
      const int columns = std::min(kPanelColumns, n - j);
      T* panel = a + j + static_cast<std::size_t>(j) * stride;
      if (j > 0)
        subtract_product(m - j, columns, j, a + j, stride, {panel, stride, identity_.data(), identity_.data()});
      if (!factor_panel(m - j, columns, panel, stride)) return false;
    }
    return true;
  }

  // y = L^-1 y for the n x n triangle of L, then w += (rows below) y: L is m x n and w has m - n entries.
  static void solve_forward(int m, int n, const T* l, std::size_t stride, T* y, T* w) {
    constexpr int kColumns = 4;
    int j = 0;
    for (; j + kColumns <= n; j += kColumns) {
      const T* c[kColumns];
      for (int e = 0; e < kColumns; ++e) c[e] = l + static_cast<std::size_t>(j + e) * stride;
      for (int e = 0; e < kColumns; ++e) {
        const T x = y[j + e] /= c[e][j + e];
        for (int i = j + e + 1; i < j + kColumns; ++i) y[i] -= c[e][i] * x;
      }
      const T x0 = y[j], x1 = y[j + 1], x2 = y[j + 2], x3 = y[j + 3];
      for (int i = j + kColumns; i < n; ++i) y[i] -= c[0][i] * x0 + c[1][i] * x1 + c[2][i] * x2 + c[3][i] * x3;
      for (int i = n; i < m; ++i) w[i - n] += c[0][i] * x0 + c[1][i] * x1 + c[2][i] * x2 + c[3][i] * x3;
    }
    for (; j < n; ++j) {
      const T* c = l + static_cast<std::size_t>(j) * stride;
      const T x = y[j] /= c[j];
      for (int i = j + 1; i < n; ++i) y[i] -= c[i] * x;
      for (int i = n; i < m; ++i) w[i - n] += c[i] * x;
    }
  }

  // y = L^-T (y - (rows below)^T w).
  static void solve_backward(int m, int n, const T* l, std::size_t stride, T* y, const T* w) {
    for (int end = n; end > 0;) {
      const int begin = end % kDots == 0 ? end - kDots : end - end % kDots;
      T sums[kDots] = {};
      const T* c = l + static_cast<std::size_t>(begin) * stride;
      if (end - begin == kDots) {
        dots(n - end, c + end, stride, y + end, sums);
        dots(m - n, c + n, stride, w, sums);
      } else {
        for (int e = 0; e < end - begin; ++e, c += stride) {
          for (int i = end; i < n; ++i) sums[e] += c[i] * y[i];
          for (int i = n; i < m; ++i) sums[e] += c[i] * w[i - n];
        }
      }
      for (int j = end - 1; j >= begin; --j) {
        const T* column = l + static_cast<std::size_t>(j) * stride;
        T sum = sums[j - begin];
        for (int i = j + 1; i < end; ++i) sum += column[i] * y[i];
        y[j] = (y[j] - sum) / column[j];
      }
      end = begin;
    }
  }

 private:
  static constexpr int kTilePacks = 2, kTileRows = kTilePacks * kLanes;
  static constexpr int kTileColumns = 6;                      // with kTilePacks fills the 16 registers of AVX2
  static constexpr int kLargeColumns = 48, kLargeDepth = 32;  // from which on copying pays
  static constexpr int kPanelColumns = 96;
  // Rows and depth of the copy of A in a large product, for the second cache (200 kB of doubles).
  static constexpr int kCopiedRows = 128, kCopiedDepth = 192;
  static constexpr int kDots = 4;

  static Pack load(const T* p) {
    Pack pack;
    std::memcpy(&pack, p, sizeof pack);
    return pack;
  }
  static void store(T* p, const Pack& pack) { std::memcpy(p, &pack, sizeof pack); }

  // Of the product of kTileRows x k and k x kColumns, subtracts m rows.
  template <int kColumns>
  static void subtract_tile_of(int m, int k, const T* a, std::size_t a_stride, const T* b, std::size_t b_stride,
                               const Target& target, int row, int column) {
    Pack sums[kColumns][kTilePacks] = {};
    for (int l = 0; l < k; ++l, a += a_stride, b += b_stride) {
      Pack packs[kTilePacks];
      for (int p = 0; p < kTilePacks; ++p) packs[p] = load(a + p * kLanes);
      for (int j = 0; j < kColumns; ++j)
        for (int p = 0; p < kTilePacks; ++p) sums[j][p] += packs[p] * b[j];
    }
    const int* rows = target.rows + row;
    const bool adjacent = m == kTileRows && rows[kTileRows - 1] - rows[0] == kTileRows - 1;
    for (int j = 0; j < kColumns; ++j) {
      T* to = target.to + target.stride * static_cast<std::size_t>(target.columns[column + j]);
      if (adjacent) {
        for (int p = 0; p < kTilePacks; ++p)
          store(to + rows[0] + p * kLanes, load(to + rows[0] + p * kLanes) - sums[j][p]);
      } else {
        T values[kTileRows];
        for (int p = 0; p < kTilePacks; ++p) store(values + p * kLanes, sums[j][p]);
        for (int i = 0; i < m; ++i) to[rows[i]] -= values[i];
      }
    }
  }

  static void subtract_tile(int m, int n, int k, const T* a, std::size_t a_stride, const T* b, std::size_t b_stride,
                            const Target& target, int row, int column) {
    static_assert(kTileColumns == 6);
    switch (n) {
      case 6: return subtract_tile_of<6>(m, k, a, a_stride, b, b_stride, target, row, column);
      case 5: return subtract_tile_of<5>(m, k, a, a_stride, b, b_stride, target, row, column);
      case 4: return subtract_tile_of<4>(m, k, a, a_stride, b, b_stride, target, row, column);
      case 3: return subtract_tile_of<3>(m, k, a, a_stride, b, b_stride, target, row, column);
      case 2: return subtract_tile_of<2>(m, k, a, a_stride, b, b_stride, target, row, column);
      default: return subtract_tile_of<1>(m, k, a, a_stride, b, b_stride, target, row, column);
    }
  }

  // The same as subtract_product(), with A and B copied to where they stay in the caches (Goto & van de Geijn, ACM
  // Trans. Math. Softw. 34, 2008).
  void subtract_large_product(int m, int n, int k, const T* a, std::size_t stride, const Target& target) {
    for (int l = 0; l < k; l += kCopiedDepth) {
      const int depth = std::min(kCopiedDepth, k - l);
      const T* from = a + static_cast<std::size_t>(l) * stride;
      copy_tiles<kTileColumns>(n, depth, from, stride, columns_);
      for (int i = 0; i < m; i += kCopiedRows) {
        const int rows = std::min(kCopiedRows, m - i);
        copy_tiles<kTileRows>(rows, depth, from + i, stride, rows_);
        for (int j = 0; j < std::min(n, i + rows); j += kTileColumns)
          for (int tile = std::max(0, (j - i) / kTileRows * kTileRows); tile < rows; tile += kTileRows)
            subtract_tile(std::min(kTileRows, rows - tile), std::min(kTileColumns, n - j), depth,
                          rows_.data() + tile * depth, kTileRows, columns_.data() + j * depth, kTileColumns, target,
                          i + tile, j);
      }
    }
  }

  template <int kTile>
  static void copy_tiles(int rows, int depth, const T* a, std::size_t stride, std::vector<T>& copy) {
    const auto size = static_cast<std::size_t>((rows + kTile - 1) / kTile * kTile * depth);
    if (copy.size() < size) copy.resize(size);
    T* to = copy.data();
    for (int i = 0; i < rows; i += kTile) {
      const T* from = a + i;
      for (int l = 0; l < depth; ++l, from += stride, to += kTile) std::memcpy(to, from, kTile * sizeof(T));
    }
  }

  // Tiles of columns: each is updated by those before it, then factored column by column.
  bool factor_panel(int m, int n, T* a, std::size_t stride) {
    for (int j = 0; j < n; j += kTileColumns) {
      const int columns = std::min(kTileColumns, n - j);
      T* tile = a + j + static_cast<std::size_t>(j) * stride;
      if (j > 0) subtract_product(m - j, columns, j, a + j, stride, {tile, stride, identity_.data(), identity_.data()});
      for (int c = 0; c < columns; ++c) {
        T* x = tile + static_cast<std::size_t>(c) * stride;
        if (!(x[c] > 0)) return false;
        x[c] = std::sqrt(x[c]);
        const T inverse = 1 / x[c];
        for (int i = c + 1; i < m - j; ++i) x[i] *= inverse;
        for (int d = c + 1; d < columns; ++d) {
          T* y = tile + static_cast<std::size_t>(d) * stride;
          const T factor = x[d];
          for (int i = d; i < m - j; ++i) y[i] -= factor * x[i];
        }
      }
    }
    return true;
  }

  void reserve_identity(int n) {
    for (int i = static_cast<int>(identity_.size()); i < n; ++i) identity_.push_back(i);
  }

  // sums[e] += c_e . x for kDots columns.
  static void dots(int n, const T* c, std::size_t stride, const T* x, T* sums) {
    Pack packs[kDots] = {};
    int i = 0;
    for (; i + kLanes <= n; i += kLanes)
      for (int e = 0; e < kDots; ++e) packs[e] += load(c + static_cast<std::size_t>(e) * stride + i) * load(x + i);
    for (int e = 0; e < kDots; ++e) {
      const T* column = c + static_cast<std::size_t>(e) * stride;
      for (int lane = 0; lane < kLanes; ++lane) sums[e] += packs[e][lane];
      for (int rest = i; rest < n; ++rest) sums[e] += column[rest] * x[rest];
    }
  }

  std::vector<T> rows_, columns_;  // copies
  std::vector<int> identity_;
};

}  // namespace orthodyn
