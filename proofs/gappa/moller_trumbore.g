# What Gappa says of Möller and Trumbore's u, v and 1-(u+v) in f32, where u, v and u+v are between 0 and 1 (docs/design/related.md):
#     gappa moller_trumbore.g
# Differences of inputs are variables, as in hairline's certificates: E1 = b-a, E2 = c-a, S = o-a. |N·d| is at least 1/2.
@rnd = float<ieee_32, ne>;
e1x = rnd(E1x); e1y = rnd(E1y); e1z = rnd(E1z);
e2x = rnd(E2x); e2y = rnd(E2y); e2z = rnd(E2z);
sx = rnd(Sx); sy = rnd(Sy); sz = rnd(Sz);
px rnd= dy*e2z - e2y*dz; py rnd= dz*e2x - e2z*dx; pz rnd= dx*e2y - e2x*dy;
det rnd= e1x*px + e1y*py + e1z*pz;
inv rnd= 1/det;
nu rnd= sx*px + sy*py + sz*pz;
u rnd= nu*inv;
qx rnd= sy*e1z - e1y*sz; qy rnd= sz*e1x - e1z*sx; qz rnd= sx*e1y - e1x*sy;
nv rnd= dx*qx + dy*qy + dz*qz;
v rnd= nv*inv;
w rnd= 1 - (u + v);
QX = Sy*E1z - E1y*Sz; QY = Sz*E1x - E1z*Sx; QZ = Sx*E1y - E1x*Sy;
NV = dx*QX + dy*QY + dz*QZ;
PX = dy*E2z - E2y*dz; PY = dz*E2x - E2z*dx; PZ = dx*E2y - E2x*dy;
DET = E1x*PX + E1y*PY + E1z*PZ;
NU = Sx*PX + Sy*PY + Sz*PZ;
U = NU/DET; M = nu/det; V = NV/DET; K = nv/det; W = 1 - (U + V);
{ |E1x| <= 0.9990234375 /\ |E1y| <= 0.9990234375 /\ |E1z| <= 0.9990234375 /\
  |E2x| <= 0.9990234375 /\ |E2y| <= 0.9990234375 /\ |E2z| <= 0.9990234375 /\
  |Sx| <= 0.9990234375 /\ |Sy| <= 0.9990234375 /\ |Sz| <= 0.9990234375 /\
  |dx| <= 1 /\ |dy| <= 1 /\ |dz| <= 1 /\
  DET in [0.5, 6] /\ U in [0,1] /\ V in [0,1] /\ U + V in [0,1] ->
  |u - U| in ? /\ |v - V| in ? /\ |w - W| in ? }
# How a quotient's error is made of its parts; Gappa checks that both sides are the same.
M - U -> ((nu - NU) - U*(det - DET))/det {det<>0, DET<>0};
u - U -> (u - nu*inv) + (nu*inv - M) + (M - U);
nu*inv - M -> M*((inv - 1/det)/(1/det)) {det<>0};
M -> U + (M - U);
K - V -> ((nv - NV) - V*(det - DET))/det {det<>0, DET<>0};
v - V -> (v - nv*inv) + (nv*inv - K) + (K - V);
nv*inv - K -> K*((inv - 1/det)/(1/det)) {det<>0};
K -> V + (K - V);
