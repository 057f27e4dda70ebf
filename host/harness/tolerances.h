// Bounds of the checks and of the tests that share them, each with its reason.
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

/// log2 of the cell size: the area is a difference of products in single precision, at least 1/64
/// of either where it counts (below, the limit of K_a decides): 64 * 6e-8 / ln 2, and log2's error
/// on levels down to -30. Box: products of two floats.
inline constexpr double kFootprintLevel = 6e-6, kFootprintExtent = 2e-7;

// Elementary functions, as kernels/wide/wide_math.clh states them.
inline constexpr double kExp2Error = 5e-7, kLog2Error = 2e-7, kReciprocalError = 2e-7;
inline constexpr double kRsqrtError = 3e-7, kQuantileError = 1.2e-6;
inline constexpr double kExpComplementError = 1e-5;

/// Deviations of the mean of stratified draws in standard errors; four are exceeded once in 16,000
/// cases of independent draws, and stratified ones spread less.
inline constexpr double kMeanStandardErrors = 4;
/// Relative error of the variance of 65536 stratified draws: 2 % of it stays open.
inline constexpr double kVarianceTolerance = 0.025;
/// Share of summed draws that may differ from Boost.Math's quantile: sums in single precision are
/// good to 1e-7, and steps of the quantile are 1e-4 apart and more.
inline constexpr double kFlippedDrawShare = 1e-3;
/// Draws from the normal distribution, in standard deviations beyond whole numbers: what the
/// Cornish-Fisher expansion leaves.
inline constexpr double kExpansionSigmas = 0.01;

/// Mean of glints over many cells against the smooth lobe: 1 %, and a quarter of it as the standard
/// error of that mean.
inline constexpr double kEnergyTolerance = 0.01;

/// Mean of a highlight over pixels that are half as wide again as it, of a lobe widened for them:
/// what masking by the wider lobe takes, what a bounded sum of Gaussians leaves.
inline constexpr double kCurvedEnergy = 0.03;
/// A lobe over a pixel's box, steps up to its roughness, over its brightest: a rectangle for a
/// parallelogram, and four Gaussians for GGX, which are good to 3.3 %.
inline constexpr double kFootprintMean = 0.01, kFootprintGgx = 0.035;

/// Under many lights, of which some are drawn as one: distance of pixels' distribution from brute
/// force, of its mean deviation, where even all drawn one by one are 0.11 off; change as lights of
/// 0.2 % apart change ranks; and variance, of which 3 % stay open.
inline constexpr double kDrawnSpread = 0.15, kDrawnJump = 0.05, kDrawnVariance = 0.08;

/// Share of pixels that are alike by chance: those in which nothing reflects, or two numbers agree.
inline constexpr double kRecurringShare = 0.02;

/// What method kemppinen loses of the lobe: its particles' Gaussians are cut off at two cells.
inline constexpr double kParticleLoss = 0.08;
/// Share of numbers whose published hash may differ from the reference's: sines are good to 0.6
/// ulp, and where they lie half-way between two floats either is right.
inline constexpr double kSineHashShare = 0.02;
/// Mean of the published draws of few microdetails: two distributions are blended for one, and a
/// tail is cut off.
inline constexpr double kPublishedMean = 0.02;
/// Share of pixels that may differ from the reference's where method deliot_belcour rounds 48 real
/// numbers, and where published_zk16 multiplies the last bit of a sine by 753, four times a cell.
inline constexpr double kRoundedPixelShare = 0.01, kSineHashPixelShare = 0.06;
/// Change of rivals per hundredth of a pixel: a tent over a pixel changes by 2 % of its contrast.
inline constexpr double kRivalMotion = 0.04;

/// Share of pixels that a relative step of 4e-6 in the probability may change: some twenty cells
/// with draws of mean 32 and less each change with that step times the mean, 2.6e-3, and single
/// precision moves thresholds by as much again.
inline constexpr double kCrossingShare = 6e-3;

/// The smooth lobe under a cone of light, relative to the integral or to the brightest of that
/// view: quadrature of up to 8 x 8 points over a Gaussian leaves 1.4 %, and where the horizon cuts
/// a cone wider than a lobe of any roughness, its corner falls between the points.
inline constexpr double kNarrowConeTolerance = 0.02, kWideConeTolerance = 0.2;
inline constexpr double kConeNarrow_deg = 45;
/// The same at views of less than 0.1 degrees above the surface, which are raised to a twentieth
/// of a degree: narrow lobes and lights change by 6 % of the brightest on the way there.
inline constexpr double kSilhouetteCone = 0.08;
/// The share of reflecting microdetails under a cone, relative, up to a half-angle of 20 degrees
/// and beyond. A microdetail's own share is taken for that of an ellipse, which a cone's half
/// vectors fill where neither the horizon cuts them nor a grazing view bends them.
inline constexpr double kConeProbability = 0.05, kWideConeProbability = 0.15;
/// Chords across a groove are taken one by one, which the horizon's edge defeats.
inline constexpr double kWideGrooveProbability = 0.25;
/// Anywhere, as a factor.
inline constexpr double kProbabilityMagnitude = 5;
/// GGX lobes under a cone, relative to the integral or the highlight: four Gaussians leave 3.3 %,
/// quadrature over each 1.4 %.
inline constexpr double kGgxTolerance = 0.05;
/// What one reflecting microdetail sends of a polygon, relative, at views from 3 degrees on: an
/// ellipse stands for the light's half vectors, and one direction for all of its light.
inline constexpr double kPolygonBrightness = 0.2;
/// The same of lights that are points to a microdetail.
inline constexpr double kTinyPolygonBrightness = 0.02;
/// The share of reflecting microdetails under a polygon, relative, from 30 degrees on: what the
/// transformed cosine reflects too much or too little. A Gaussian falls off faster than a cosine
/// can be bent to.
inline constexpr double kGgxPolygonProbability = 0.1, kPolygonProbability = 0.25;
inline constexpr double kConeDiffuseTolerance = 0.002;

/// Form factors: single precision over a dozen terms of at most 1/2, and the edge fit's 1e-7.
inline constexpr double kFormFactorTolerance = 1e-5;
/// Relative, of lights from 1e-6 steradians on.
inline constexpr double kSmallLightRelative = 1e-3;
/// Relative, of tiny lights: directions are good to 6e-8, differences of directions of a light of
/// 1e-10 steradians, 1e-5 wide, to 6e-3.
inline constexpr double kTinyLightRelative = 0.03;
/// The same transformed cosine in double precision: interpolation and a dozen terms in single
/// precision. Lobes of roughness alpha turn an error of direction of 1e-7 into 1e-7 / alpha.
inline constexpr double kSameLobe = 2e-4;
/// An anisotropic lobe seen straight down and 1e-4 off, from all sides.
inline constexpr double kStraightDown = 1e-3;
/// A surface of two equal roughnesses by the table of four axes against the one of round lobes, of
/// 64 nodes: at views from 15 degrees, mean and worst, of the light.
inline constexpr double kRoundByStretchedMean = 6e-4, kRoundByStretched = 0.02;
/// What anisotropic surfaces reflect of a quad against their BRDF's own integral, as far as one
/// cosine can be it: mean error over mean reflected, by the ratio of roughnesses. A round lobe has
/// 0.22, 0.43, 0.52 and 0.74.
inline constexpr double kStretched2 = 0.06, kStretched5 = 0.09, kStretched10 = 0.13,
                        kStretched1000 = 0.3;
/// Albedo of an anisotropic surface, interpolated between eight nodes an axis: worst at alpha 0.1,
/// 1 : 10, seen at 12 degrees.
inline constexpr double kStretchedAlbedo = 0.025;
/// Discs, spheres and tubes the same way, against a thousand facets; and against a quarter of a
/// million rays.
inline constexpr double kRoundLight = 1e-4, kRoundLightByRays = 3e-4;
/// A hemisphere of light against the table's albedo: the light is 2e5 wide, not infinite, and the
/// scale of the lobe was fitted.
inline constexpr double kHemisphereAlbedo = 2e-3;
/// Diffuse and specular lobe reflect at most everything together, and table cells overshoot a
/// little.
inline constexpr double kMostReflected = 1.005;
/// Roughness from the length of a mean normal by the published polynomials, in single precision.
inline constexpr double kMesoAlpha = 1e-5;

/// Texture fetches: positions are good to 2^-16 texels and levels to some 1e-6; neighbouring random
/// texels differ by up to 2, and a probe adds eight of them.
inline constexpr double kFetchTolerance = 3e-4;
/// Mip level: single precision of axes and logarithm.
inline constexpr double kLevelTolerance = 1e-5;

/// Lobes of normals, differences in units of their own bounds: weights 1e-7, means 1e-6 and
/// variances 4e-7 (second moments near 1 in single precision), cosines 1e-5 (some ten roundings).
inline constexpr double kLobeWeight = 1e-7, kLobeMean = 1e-6, kLobeVariance = 4e-7;
inline constexpr double kLobeCosine = 1e-5;
/// Relative: the rational fit of Smith's Lambda is good to 0.35 % of G1, here for light and view.
inline constexpr double kMaskingTolerance = 7e-3;
/// Relative: the fitted share of a Gaussian of normals that lies on the unit disk.
inline constexpr double kDiskMass = 0.01;
/// Brightness below which a difference does not show: the peak of the base lobe is above 1.
inline constexpr double kDark = 1e-4;

/// Sine, cosine and angle in turns, as kernels/wide/wide_trig.clh states them.
inline constexpr double kSineError = 3e-7, kAngleError = 1e-6;
/// Draws one in ten thousand by the expansion of second order: the third is 0.02 of a microdetail
/// there, and draws that are whole numbers differ by 1 in a few of a hundred.
inline constexpr double kExpandedTail = 0.1;
/// What is left of lobes that merge within 3 % of the base lobe's variance each.
inline constexpr double kMergedLobes = 0.02;
/// Schlick's term of mapped cones is asked for where it is at least this share of the lobe.
inline constexpr double kDarkSchlick = 1e-3;

/// Directions in a pixel's frame: 8 bytes hold it to 4e-6 rad, and float adds some 1e-6.
inline constexpr double kFrameError = 1e-5;
/// Energy that metals get back, of all: a polynomial of the eighth degree, and the albedo of the
/// rational fit of Smith's Lambda, good to 0.35 % of G1.
inline constexpr double kCompensationTolerance = 6e-3;
/// Energy of a diffuse layer and a lobe above it, of all: two polynomials of the seventh degree,
/// and sums over 4096 directions.
inline constexpr double kCouplingTolerance = 5e-3;

/// A footprint that holds a whole map, relative. One tilted normal: rounding and the rational fit
/// of Smith's Lambda. Four that a mixture keeps apart: those, and what EM's shared normals leave. A
/// Gaussian in place of four normals a third of the base lobe apart: its fourth moment, which the
/// diffuse layer no longer hides where the lobe leaves it little. Phong peaks in place of Beckmann
/// lobes: cos^n falls off later.
inline constexpr double kTiltedLobe = 0.005, kGaussianOfNormals = 0.045, kPhongPeaks = 0.12;

/// What facets of LEADR show, relative: a few texels between slopes; and nine points a side for a
/// diffuse mean whose clamps have kinks, from 15 degrees over slopes of a deviation of 1.
inline constexpr double kLeadrHighlight = 0.01, kLeadrDiffuse = 0.12;

/// Multiple scattering, relative to a Lambertian lobe's radiance: single precision and the
/// polynomials in a cosine.
inline constexpr double kScatterTolerance = 5e-4;
/// With masking, which on smooth surfaces sets in within cosines of the size of their roughness:
/// polynomials do not follow that, and are off by part of the two hundredths that the published
/// lobes hold there.
inline constexpr double kMaskedScatterTolerance = 3e-3;
/// White furnaces of the analytic models: the polynomials of a share are good to 2e-3 of all
/// energy.
inline constexpr double kFurnaceTolerance = 2e-3;
/// Energy of one bounce against Smith's theory, which takes heights and slopes to be independent;
/// those of a smooth surface are not. Measured 0.020 at most.
inline constexpr double kSmithTolerance = 0.03;
/// Variance of the facets' slopes: amplitudes are floats and heights are counts.
inline constexpr double kSlopeVariance = 1e-5;
/// Kurtosis of a Gaussian's slopes, of a tile of some 7000 independent facets: 0.06 is its standard
/// error.
inline constexpr double kSlopeKurtosis = 0.3;

/// Walks under Smith's theory, half a million: what is still on its way after six bounces at
/// roughness 0.8; counting errors of an energy, of 256 blocks of directions, and of the twelfth of
/// the rays in a band, 3.5 standard errors.
inline constexpr double kWhiteWalk = 6e-4, kWalkEnergy = 2.5e-3, kWalkDirections = 0.015,
                        kWalkReciprocity = 0.04;

}  // namespace glintmark
