// What the planes say of pixels, for tests of kernels that read none.
#include "pixel.clh"

// out: six arrays of frame->plane_stride numbers, unit vectors to the eye and to the light (given
// in world axes) in the local frame.
WIDE_KERNEL void probePixels(global const uint* planes, constant const FrameParams* frame,
                             float light_x, float light_y, float light_z, global float* out) {
  const size_t stride = frame->plane_stride, entry = get_global_id(0) * WIDTH;
  if (entry >= stride) return;
  const ShadingFrame basis = unpackFrame(loadUint(planes, PLANE_FRAME0 * stride + entry),
                                         loadUint(planes, PLANE_FRAME1 * stride + entry));
  const vfloat3 view = viewDirection(loadUint(planes, PLANE_PIXEL * stride + entry), frame, basis);
  const vfloat3 axis = toLocal(basis, broadcast3((float4)(light_x, light_y, light_z, 0.0f)));
  storeFloat(view.x, out, entry);
  storeFloat(view.y, out, stride + entry);
  storeFloat(view.z, out, 2 * stride + entry);
  storeFloat(axis.x, out, 3 * stride + entry);
  storeFloat(axis.y, out, 4 * stride + entry);
  storeFloat(axis.z, out, 5 * stride + entry);
}
