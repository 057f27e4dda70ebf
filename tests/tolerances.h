// Bounds that several tests share, each with its reason.
#pragma once

namespace glintmark {

/// Relative difference in the smooth lobe between the kernel and the double-precision reference:
/// the rational fit of Smith's Lambda is good to 0.35 %, and the rest is single precision.
inline constexpr double kLobeTolerance = 5e-3;

/// Difference in radiance relative to the smooth lobe between the kernel and the reference where
/// both drew the same microdetails: cell weights and the lobe are good to some 1e-6, times the
/// number of cells.
inline constexpr double kShareTolerance = 1e-4;

/// Share of pixels in which some draw may differ from the reference's. A draw flips when rounding
/// moves a threshold across its random number: thresholds are good to 1e-6 relative, and a pixel
/// makes 8 to 128 draws.
inline constexpr double kFlippedPixelShare = 2e-3;

/// Share of pixels whose cell count may differ in method exact (by 2 at most): a cell counts where
/// it shares more than 1e-6 of itself with the footprint, and areas are good to some 1e-7. Method
/// zk16 has no such threshold and agrees in every pixel.
inline constexpr double kThresholdCountShare = 5e-3;

/// Machine instructions by which two programs differ that only find their planes in other slots:
/// constants of four address computations. The smallest effect (metal compensation) takes 20.
inline constexpr double kPlaneSlotInstructions = 8;

}  // namespace glintmark
