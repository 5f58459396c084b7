#pragma once

namespace tunica::smoothers {

/// y = M x, M of n rows and columns, column by column.
void dense_product(int n, const double* M, const double* x, double* y);
void dense_product(int n, const float* M, const double* x, double* y);

}  // namespace tunica::smoothers
