// Debian's Trilinos 13.2 was built with a GCC that drops the calls of KLU_lsolve inside
// klu_solve2, so that Amesos2's KLU2 is silently wrong on two ranks and more
// (trilinos/Trilinos pull request 12232). This instantiation, compiled without the two
// inter-procedural passes at fault, stands in the executable and so pre-empts the library's.
#include <Amesos2.hpp>
#include <Amesos2_KLU2_decl.hpp>
#include <Amesos2_KLU2_def.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_MultiVector.hpp>

namespace Amesos2 {
template class KLU2<Tpetra::CrsMatrix<double, int, long long>,
                    Tpetra::MultiVector<double, int, long long>>;
}
