// The records of all methods, one function each, for the registry and the tests.
#pragma once

#include "Kernels/Estimation/EstimationMethod.h"

namespace msi
{

// The source's and their baselines: PublishedMethods.cpp.
EstimationMethod directMethod();
EstimationMethod pinvMethod();
EstimationMethod pooledMethod();
EstimationMethod rModelMethod();
EstimationMethod bandedMethod();

EstimationMethod transferMethod();

// Wiener estimation with a smoothness prior, r = m + C M' (M C M' + noise)^-1 (u - M m - b): C a
// first-order Markov covariance, C_ij = s^2 rho^|i - j|; m, s^2, the camera's M and b and the noise of
// each channel from the samples (ridge regression of responses on reflectances).
// Source: Pratt and Mancill, 1976, doi 10.1364/AO.15.000073.
// Chosen: rho, the ridge, the weight of tuning samples.
EstimationMethod wienerMethod();

// Wiener estimation whose mean and covariance are those of the samples with the nearest responses;
// M, b and noise as for wiener.
// Source: Shen, Cai, Shao and Xin, 2007, doi 10.1364/OE.15.015545. There the samples are selected by a
//         first estimate of their spectra; here by their responses.
// Chosen: the number of neighbours and the weight of tuning samples.
EstimationMethod adaptiveWienerMethod();

// The first p principal components of the reflectances, their scores by least squares on the responses.
// Source: Imai and Berns, "Spectral estimation using trichromatic digital cameras", Proc. Int. Symp. on
//         Multispectral Imaging and Color Reproduction for Digital Archives, 1999, 42-49.
// Chosen: p, the weight of tuning samples.
EstimationMethod pcaMethod();

// Kernel ridge regression of reflectance on responses (divided by their deviation), Gaussian and
// logarithmic kernels.
// Source: Heikkinen et al., 2007, doi 10.1364/JOSAA.24.002673.
// Chosen: kernel, length, penalty, weight of tuning samples; by leave-one-out in closed form.
EstimationMethod kernelRidgeMethod();

// Locally weighted linear regression on the nearest responses.
// Source: Cleveland, 1979, doi 10.1080/01621459.1979.10481038.
// Chosen: number of neighbours, penalty, weight of tuning samples.
EstimationMethod localLinearMethod();

// Ridge regression on the responses and, where that is better, their squares or all products of two.
// Source: Hong, Luo and Rhodes, 2001, doi 10.1002/1520-6378(200102)26:1<76::AID-COL8>3.0.CO;2-3.
// Chosen: terms, penalty, weight of tuning samples; by leave-one-out in closed form.
EstimationMethod polynomialMethod();

// The same with the roots of products of two responses, which scale with the exposure as responses do.
// Source: Finlayson, Mackiewicz and Hurlbert, 2015, doi 10.1109/TIP.2015.2405336.
EstimationMethod rootPolynomialMethod();

// W with an L1 penalty on its coefficients, band by band: the lasso on responses divided by their deviation.
// Source: Tibshirani, 1996, doi 10.1111/j.2517-6161.1996.tb02080.x; cyclic coordinate descent: Friedman,
//         Hastie and Tibshirani, 2010, doi 10.18637/jss.v033.i01.
// Chosen: penalty, weight of tuning samples.
EstimationMethod sparseMethod();

} // namespace msi
