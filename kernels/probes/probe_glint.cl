// Runs single functions of the kernels over arrays, so that each can be compared with its
// definition.
#include "glint/byte_sum.clh"
#include "glint/glint.clh"
#include "glint/hash.clh"

#define FIRST (get_global_id(0) * WIDTH)

WIDE vfloat loadFloat(global const float* p, size_t i) {
  return bitsToFloat(loadUint((global const uint*)p, i));
}

WIDE_KERNEL void probeMath(global const float* in, global float* out, uint count, int function) {
  if (FIRST >= count) return;
  const vfloat x = loadFloat(in, FIRST);
  const vfloat y = function == 0   ? wideExp2(x)
                   : function == 1 ? wideLog2(x)
                   : function == 2 ? wideReciprocal(x)
                   : function == 3 ? wideRsqrt(x)
                   : function == 4 ? normalUpperQuantile(x)
                   : function == 5 ? wideRoot(x)
                                   : wideExpComplement(x);
  storeFloat(y, out, FIRST);
}

// out: coherent index, cell seed, pair seed for the half-vector cell (ju, jv).
WIDE_KERNEL void probeHash(global const uint* cell_u, global const uint* cell_v,
                           global const uint* ju, global const uint* jv, global uint* out,
                           uint count) {
  if (FIRST >= count) return;
  const vint u = coherentIndex(bitsToInt(loadUint(cell_u, FIRST)));
  const vint v = coherentIndex(bitsToInt(loadUint(cell_v, FIRST)));
  const vuint seed = mixCell(bitsToUint(u) * 0x9E3779B1u + bitsToUint(v) * 0x85EBCA77u);
  const vuint pair =
      hashDirection(seed, bitsToInt(loadUint(ju, FIRST)), bitsToInt(loadUint(jv, FIRST)));
  storeUint(bitsToUint(u), out, FIRST);
  storeUint(seed, out, count + FIRST);
  storeUint(pair, out, 2 * count + FIRST);
}

// out: U(bits) and the byte Gaussian of bits.
WIDE_KERNEL void probeRandom(global const uint* bits, global float* out, uint count) {
  if (FIRST >= count) return;
  const vuint h = loadUint(bits, FIRST);
  storeFloat(uniformFromBits(h), out, FIRST);
  storeFloat((byteSum(h) - BYTE_SUM_MEAN) / BYTE_SUM_SIGMA, out, count + FIRST);
}

// in: planes of `count` words: u whole, u fraction, v whole, v fraction, du/dx, dv/dx, du/dy,
// dv/dy. out: finer level, weight of the coarser grid, extents of the stretched box.
WIDE_KERNEL void probeFootprint(global const uint* in, global float* out, uint count,
                                constant const GlintMaterial* glints) {
  if (FIRST >= count) return;
#define WORD(plane) loadUint(in, (plane) * (size_t)count + FIRST)
  const FixedUv u = {bitsToInt(WORD(0)), WORD(1)}, v = {bitsToInt(WORD(2)), WORD(3)};
  const GlintUv uv = {
      u, v, bitsToFloat(WORD(4)), bitsToFloat(WORD(5)), bitsToFloat(WORD(6)), bitsToFloat(WORD(7))};
#undef WORD
  const Footprint f = makeFootprint(uv, glints);
  storeFloat(toFloat(f.fine_level), out, FIRST);
  storeFloat(f.coarse_weight, out, count + FIRST);
  storeFloat(f.extent_u, out, 2 * (size_t)count + FIRST);
  storeFloat(f.extent_v, out, 3 * (size_t)count + FIRST);
}
