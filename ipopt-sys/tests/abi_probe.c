/* Restates what src/ declares, in C, and lets the compiler compare it with the installed headers.
 * What it prints is compared with the Rust constants by abi.rs. */
#include <stdio.h>
#if defined(IPOPT_3_14)
#include <stdbool.h>
typedef bool expected_bool;
#include "IpStdCInterface.h"
#else
typedef int expected_bool;
#include "IpStdCInterface.h"
#include "HSLLoader.h"
#endif

#define SAME(a, b) __builtin_types_compatible_p(a, b)
#define CHECK(condition) _Static_assert(condition, #condition)

typedef double *reals;
typedef int *ints;
typedef enum ApplicationReturnStatus status_t;

CHECK(SAME(expected_bool, Bool));
CHECK(SAME(void *, UserDataPtr));
CHECK(SAME(struct IpoptProblemInfo *, IpoptProblem));
CHECK(sizeof(enum ApplicationReturnStatus) == sizeof(int));
CHECK(sizeof(enum AlgorithmMode) == sizeof(int));

CHECK(SAME(Eval_F_CB, Bool (*)(int, reals, Bool, reals, void *)));
CHECK(SAME(Eval_Grad_F_CB, Bool (*)(int, reals, Bool, reals, void *)));
CHECK(SAME(Eval_G_CB, Bool (*)(int, reals, Bool, int, reals, void *)));
CHECK(SAME(Eval_Jac_G_CB, Bool (*)(int, reals, Bool, int, int, ints, ints, reals, void *)));
CHECK(SAME(Eval_H_CB, Bool (*)(int, reals, Bool, double, int, reals, Bool, int, ints, ints, reals,
                               void *)));
CHECK(SAME(Intermediate_CB, Bool (*)(int, int, double, double, double, double, double, double,
                                     double, double, int, void *)));

CHECK(SAME(__typeof__(&CreateIpoptProblem),
           IpoptProblem (*)(int, reals, reals, int, reals, reals, int, int, int, Eval_F_CB,
                            Eval_G_CB, Eval_Grad_F_CB, Eval_Jac_G_CB, Eval_H_CB)));
CHECK(SAME(__typeof__(&FreeIpoptProblem), void (*)(IpoptProblem)));
CHECK(SAME(__typeof__(&AddIpoptStrOption), Bool (*)(IpoptProblem, char *, char *)));
CHECK(SAME(__typeof__(&AddIpoptNumOption), Bool (*)(IpoptProblem, char *, double)));
CHECK(SAME(__typeof__(&AddIpoptIntOption), Bool (*)(IpoptProblem, char *, int)));
CHECK(SAME(__typeof__(&OpenIpoptOutputFile), Bool (*)(IpoptProblem, char *, int)));
CHECK(SAME(__typeof__(&SetIpoptProblemScaling), Bool (*)(IpoptProblem, double, reals, reals)));
CHECK(SAME(__typeof__(&SetIntermediateCallback), Bool (*)(IpoptProblem, Intermediate_CB)));
CHECK(SAME(__typeof__(&IpoptSolve),
           status_t (*)(IpoptProblem, reals, reals, reals, reals, reals, reals, void *)));

#if defined(IPOPT_3_14)
CHECK(SAME(__typeof__(&GetIpoptCurrentIterate),
           Bool (*)(IpoptProblem, Bool, int, reals, reals, reals, int, reals, reals)));
CHECK(SAME(__typeof__(&GetIpoptCurrentViolations),
           Bool (*)(IpoptProblem, Bool, int, reals, reals, reals, reals, reals, int, reals,
                    reals)));
#else
CHECK(SAME(ipfint, int));
CHECK(SAME(ma57id_t, void (*)(reals, ints)));
CHECK(SAME(ma57ad_t, void (*)(ints, ints, const int *, const int *, ints, ints, ints, ints, ints,
                              reals)));
CHECK(SAME(ma57bd_t, void (*)(ints, ints, reals, reals, ints, ints, ints, ints, ints, ints, ints,
                              reals, ints, reals)));
CHECK(SAME(ma57cd_t, void (*)(ints, ints, reals, ints, ints, ints, ints, reals, ints, reals, ints,
                              ints, ints, ints)));
CHECK(SAME(ma57ed_t, void (*)(ints, ints, ints, reals, ints, reals, ints, ints, ints, ints, ints,
                              ints)));
CHECK(SAME(__typeof__(&LSL_setMA57), void (*)(ma57ad_t, ma57bd_t, ma57cd_t, ma57ed_t, ma57id_t)));
CHECK(SAME(__typeof__(&LSL_loadHSL), int (*)(const char *, char *, int)));
CHECK(SAME(__typeof__(&LSL_HSLLibraryName), char *(*)()));
CHECK(SAME(__typeof__(&LSL_unloadHSL), int (*)()));
CHECK(SAME(__typeof__(&LSL_isHSLLoaded), int (*)()));
CHECK(SAME(__typeof__(&LSL_isMA57available), int (*)()));
#endif

#define PRINT(name) printf("%s %d\n", #name, (int)(name))

int main(void) {
    PRINT(sizeof(Number));
    PRINT(sizeof(Index));
    PRINT(sizeof(Int));
    PRINT(sizeof(Bool));
    PRINT(TRUE);
    PRINT(FALSE);
    PRINT(Solve_Succeeded);
    PRINT(Solved_To_Acceptable_Level);
    PRINT(Infeasible_Problem_Detected);
    PRINT(Search_Direction_Becomes_Too_Small);
    PRINT(Diverging_Iterates);
    PRINT(User_Requested_Stop);
    PRINT(Feasible_Point_Found);
    PRINT(Maximum_Iterations_Exceeded);
    PRINT(Restoration_Failed);
    PRINT(Error_In_Step_Computation);
    PRINT(Maximum_CpuTime_Exceeded);
    PRINT(Not_Enough_Degrees_Of_Freedom);
    PRINT(Invalid_Problem_Definition);
    PRINT(Invalid_Option);
    PRINT(Invalid_Number_Detected);
    PRINT(Unrecoverable_Exception);
    PRINT(NonIpopt_Exception_Thrown);
    PRINT(Insufficient_Memory);
    PRINT(Internal_Error);
    PRINT(RegularMode);
    PRINT(RestorationPhaseMode);
    return 0;
}
