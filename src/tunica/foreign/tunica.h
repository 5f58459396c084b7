#ifndef TUNICA_H
#define TUNICA_H
/*
 * Solves K x = b for a sparse matrix K of any program: saddle-point systems with vector and scalar
 * unknowns (velocities and pressures, displacements and multipliers) in any order, and matrices of
 * one kind. From C, or from a language that calls C; docs/smoothers-in-your-program.md has examples.
 *
 *   tunica_solver* solver = tunica_create(n, offsets, columns, values, NULL, NULL);
 *   if (tunica_solve(solver, b, x) != TUNICA_SOLVED) puts(tunica_query(solver)->message);
 *   tunica_destroy(solver);
 *
 * The structure of K, its null space, prescribed values and scales are found in K, and with them
 * the solver. No function throws, prints or ends the program. With a communicator all are
 * collective: every rank calls them in the same order, and gets the same status and message.
 */
#ifdef __cplusplus
extern "C" {
#endif

typedef struct tunica_solver tunica_solver;

/* What a call has come to. */
enum {
  TUNICA_SOLVED = 0,
  TUNICA_BAD_INPUT = 1,     /* the message says where, and what was expected */
  TUNICA_NOT_CONVERGED = 2, /* x is the nearest solution found */
  TUNICA_FAULT = 3          /* out of memory, or a fault of the library */
};

/* Texts belong to the solver and live until its next call. */
typedef struct {
  int status;              /* of the last call */
  int iterations;          /* of the last solve, of the setting that found x */
  int is_refresh_numeric;  /* 0 where the last refresh had to set up all anew */
  int reserved;
  long long unknowns;      /* of all ranks */
  double residual;         /* |b - K x| / |b| of the last solve */
  double backward_error;   /* |b - K x| / ||K||x| + |b||, rows divided by their size */
  double setup_seconds;    /* of the last call of each kind, of the slowest rank */
  double refresh_seconds;
  double solve_seconds;
  const char* message;     /* why the last call failed, "" if it did not; after a solve that
                              another setting had to finish, why the first ones did not */
  const char* setting;     /* name of the setting in use */
  const char* notes;       /* what was found in K and b, a line each; on rank 0 */
  const char* settings;    /* the setting in use as XML that tunica_create takes */
} tunica_report;

/*
 * A solver for the matrix of these compressed rows; it is copied. Null only where not even its
 * message finds memory: tunica_query() says whether it can be used.
 *
 *   rows          of K; of the calling rank, behind those of the ranks before
 *   offsets       rows + 1 numbers: where the entries of each row begin, from 0
 *   columns       of the whole matrix, from 0, in any order; entries given twice add up
 *   settings      XML as tunica-solvers prints and reads it, or the path of such a file; its matrix
 *                 and right-hand side are not read. Null: all is chosen by the matrix
 *   communicator  the Fortran handle of it (MPI_Comm_c2f(); Comm.py2f() of mpi4py), whose ranks
 *                 each have a part of the rows. Null: the calling process has them all
 *
 * MPI is initialised if it has not been, and ended with the program then.
 */
tunica_solver* tunica_create(long long rows, const long long* offsets, const long long* columns,
                             const double* values, const char* settings, const int* communicator);

/*
 * New values in the places that tunica_create() was given. Numeric work only, unless they contradict
 * what was found in the old ones: prescribed values, null spaces, entries that are rounding. Returns
 * the status.
 */
int tunica_refresh(tunica_solver* solver, const double* values);

/* x of K x = b, both of the rows of the calling rank. Returns the status. */
int tunica_solve(tunica_solver* solver, const double* b, double* x);

/* Never null. */
const tunica_report* tunica_query(const tunica_solver* solver);

/* Null is permitted. Before MPI_Finalize(), if the program calls that. */
void tunica_destroy(tunica_solver* solver);

#ifdef __cplusplus
}
#endif
#endif
