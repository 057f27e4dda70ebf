// Layout of the dictionary of slope distributions that methods chermain and chermain_corrected
// read, for C++ and OpenCL C alike. [CSDD20] Sect. 5
//
// DICTIONARY_LEVELS levels of DICTIONARY_SIZE marginal distributions of DICTIONARY_NODES floats:
// densities of slopes over the surface's roughness alpha, even functions, of which the half from 0
// on is stored at nodes DICTIONARY_REACH / DICTIONARY_NODES apart, linear between them and 0 from
// the last (which is not stored) on. The integral of each half is 1/2. A distribution of level l is
// the mean of 2^l Gaussian lobes and of their mirror images, the first of them those of level l
// - 1.
#ifndef GLINTMARK_SLOPE_DICTIONARY_H
#define GLINTMARK_SLOPE_DICTIONARY_H

#define DICTIONARY_SIZE 192
#define DICTIONARY_LEVELS 16
#define DICTIONARY_NODES 64

// Four standard deviations of Beckmann's slopes over alpha, sqrt(1/2) each.
#define DICTIONARY_REACH 2.82842712f
// Standard deviation of a lobe: the authors' 0.02 for a roughness of 0.5.
#define DICTIONARY_LOBE 0.04f
// A microdetail's density at its peak is one over this times the surface's, along one axis.
#define DICTIONARY_PEAK 0.0565685425f  // sqrt(2) DICTIONARY_LOBE

// First float of a distribution.
#define DICTIONARY_ROW(level, which) (((level)*DICTIONARY_SIZE + (which)) * DICTIONARY_NODES)

#endif
