#pragma once
// Pairs of numbers that fill the unit square evenly, sample after sample of a pixel.
#include <array>
#include <cstdint>

namespace tyndall {

inline std::uint32_t reversed_bits(std::uint32_t x) {
  x = (x >> 16) | (x << 16);
  x = ((x & 0xFF00FF00u) >> 8) | ((x & 0x00FF00FFu) << 8);
  x = ((x & 0xF0F0F0F0u) >> 4) | ((x & 0x0F0F0F0Fu) << 4);
  x = ((x & 0xCCCCCCCCu) >> 2) | ((x & 0x33333333u) << 2);
  return ((x & 0xAAAAAAAAu) >> 1) | ((x & 0x55555555u) << 1);
}

/// Owen's scrambling of a word whose bits are given in reverse, by a hash in which no bit affects a lower one (Laine
/// and Karras 2011, section 3.1; with the constants of Burley 2020, listing 1).
inline std::uint32_t owen_hash(std::uint32_t reversed, std::uint32_t seed) {
  reversed += seed;
  reversed ^= reversed * 0x6C50B47Cu;
  reversed ^= reversed * 0xB82F1E52u;
  reversed ^= reversed * 0xC7AFE638u;
  reversed ^= reversed * 0x8D22F6E6u;
  return reversed;
}

/// The second coordinate of Sobol's sequence, bits in reverse. Its direction numbers are the rows of Pascal's triangle
/// modulo 2 (Sobol 1967), the fifth Kronecker power of (1 1, 0 1): five butterflies instead of a product of matrices.
inline std::uint32_t sobol_second_reversed(std::uint32_t x) {
  x ^= (x >> 1) & 0x55555555u;
  x ^= (x >> 2) & 0x33333333u;
  x ^= (x >> 4) & 0x0F0F0F0Fu;
  x ^= (x >> 8) & 0x00FF00FFu;
  return x ^ (x >> 16);
}

/// Sample `index` of a two-dimensional sequence: the first 2^k samples of each coordinate lie in 2^k different cells of
/// equal size, likewise all rectangles of area 2^-k. Sobol's points, Owen-scrambled, in shuffled order (Burley 2020:
/// padding), so that sequences of different words are independent of each other.
inline std::array<std::uint32_t, 2> owen_sobol_pair(std::uint32_t index, const std::array<std::uint32_t, 4>& words) {
  // An index scrambled like a coordinate stays in the aligned blocks of 2^k indices, each of which is such a net.
  const std::uint32_t shuffled = reversed_bits(owen_hash(reversed_bits(index), words[0]));
  return {reversed_bits(owen_hash(shuffled, words[1])),
          reversed_bits(owen_hash(sobol_second_reversed(shuffled), words[2]))};
}

}  // namespace tyndall
