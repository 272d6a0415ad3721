#pragma once
// Small tables in Lanes: on AVX-512 a column is two registers, and looking it up one instruction.
#include "tyndall/number/lane_pair.h"
#include "tyndall/number/small_table.h"

namespace tyndall {

#if defined(__AVX512F__)
template <std::size_t N>
class SmallTable<Lanes, N> {
 public:
  using Row = __m512i;
  explicit SmallTable(const std::array<SharedArray, N>& columns) {
    for (std::size_t k = 0; k < N; ++k) {
      low_[k] = _mm512_loadu_ps(columns[k]->template data<float>());
      high_[k] = _mm512_loadu_ps(columns[k]->template data<float>() + 16);
    }
  }
  Row row_of(const Lanes& key) const {
    Row row = _mm512_setzero_si512();
    for (const int stride : {16, 8, 4, 2, 1}) {
      const Row further = _mm512_add_epi32(row, _mm512_set1_epi32(stride));
      row = _mm512_mask_mov_epi32(row, _mm512_cmp_ps_mask(at(0, further), key, _CMP_LE_OQ), further);
    }
    return row;
  }
  Lanes at(std::size_t column, const Row& row) const {
    return _mm512_permutex2var_ps(low_[column], row, high_[column]);
  }

 private:
  __m512 low_[N], high_[N];
};
#endif

template <std::size_t N>
class SmallTable<LanePair, N> {
 public:
  struct Row {
    typename SmallTable<Lanes, N>::Row a, b;
  };
  explicit SmallTable(const std::array<SharedArray, N>& columns) : single_(columns) {}
  Row row_of(const LanePair& key) const { return {single_.row_of(key.a), single_.row_of(key.b)}; }
  LanePair at(std::size_t column, const Row& row) const {
    return {single_.at(column, row.a), single_.at(column, row.b)};
  }

 private:
  SmallTable<Lanes, N> single_;
};

}  // namespace tyndall
