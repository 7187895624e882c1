/* The shared library that Ipopt 3.14 opens for MA57: each routine passes its arguments on to the one
 * that the program set. Their types are those of hsl.rs. Built without the C library, of which it
 * needs nothing. */

typedef void ma57ad(int *n, int *ne, const int *irn, const int *jcn, int *lkeep, int *keep,
                    int *iwork, int *icntl, int *info, double *rinfo);
typedef void ma57bd(int *n, int *ne, double *a, double *fact, int *lfact, int *ifact, int *lifact,
                    int *lkeep, int *keep, int *iwork, int *icntl, double *cntl, int *info,
                    double *rinfo);
typedef void ma57cd(int *job, int *n, double *fact, int *lfact, int *ifact, int *lifact, int *nrhs,
                    double *rhs, int *lrhs, double *work, int *lwork, int *iwork, int *icntl,
                    int *info);
typedef void ma57ed(int *n, int *ic, int *keep, double *fact, int *lfact, double *newfac, int *lnew,
                    int *ifact, int *lifact, int *newifc, int *linew, int *info);
typedef void ma57id(double *cntl, int *icntl);

static struct {
    ma57ad *ad;
    ma57bd *bd;
    ma57cd *cd;
    ma57ed *ed;
    ma57id *id;
} program;

void LSL_setMA57(ma57ad *ad, ma57bd *bd, ma57cd *cd, ma57ed *ed, ma57id *id) {
    program.ad = ad;
    program.bd = bd;
    program.cd = cd;
    program.ed = ed;
    program.id = id;
}

void ma57ad_(int *n, int *ne, const int *irn, const int *jcn, int *lkeep, int *keep, int *iwork,
             int *icntl, int *info, double *rinfo) {
    program.ad(n, ne, irn, jcn, lkeep, keep, iwork, icntl, info, rinfo);
}

void ma57bd_(int *n, int *ne, double *a, double *fact, int *lfact, int *ifact, int *lifact,
             int *lkeep, int *keep, int *iwork, int *icntl, double *cntl, int *info,
             double *rinfo) {
    program.bd(n, ne, a, fact, lfact, ifact, lifact, lkeep, keep, iwork, icntl, cntl, info, rinfo);
}

void ma57cd_(int *job, int *n, double *fact, int *lfact, int *ifact, int *lifact, int *nrhs,
             double *rhs, int *lrhs, double *work, int *lwork, int *iwork, int *icntl, int *info) {
    program.cd(job, n, fact, lfact, ifact, lifact, nrhs, rhs, lrhs, work, lwork, iwork, icntl, info);
}

void ma57ed_(int *n, int *ic, int *keep, double *fact, int *lfact, double *newfac, int *lnew,
             int *ifact, int *lifact, int *newifc, int *linew, int *info) {
    program.ed(n, ic, keep, fact, lfact, newfac, lnew, ifact, lifact, newifc, linew, info);
}

void ma57id_(double *cntl, int *icntl) {
    program.id(cntl, icntl);
}
