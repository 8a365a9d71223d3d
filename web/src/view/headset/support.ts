// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Whether a headset can show the scene, and in which kind of session.

export type HeadsetMode = 'immersive-ar' | 'immersive-vr';
/** Why there is none. */
export type HeadsetObstacle = 'no WebXR' | 'insecure' | 'no headset' | 'forbidden';
/** Why a session did not begin. */
export type HeadsetFault = 'refused' | 'busy' | 'gone' | 'failed';

/** What is asked of the browser's WebXR. */
export type Sessions = Pick<XRSystem, 'isSessionSupported'>;

/** The kind of session; one that shows the room around the scene is preferred. */
export async function headsetMode(xr: Sessions | undefined, isSecure: boolean): Promise<HeadsetMode | HeadsetObstacle> {
  if (xr === undefined) return isSecure ? 'no WebXR' : 'insecure';
  try {
    // Telephones offer the room alone: they are no headsets.
    if (!(await xr.isSessionSupported('immersive-vr'))) return 'no headset';
    return (await xr.isSessionSupported('immersive-ar')) ? 'immersive-ar' : 'immersive-vr';
  } catch {
    return 'forbidden';
  }
}

export const isMode = (found: HeadsetMode | HeadsetObstacle): found is HeadsetMode => found.startsWith('immersive');

/** What the browser's refusal of a session means. */
export function faultOf(error: unknown): HeadsetFault {
  const name = error instanceof DOMException ? error.name : '';
  if (name === 'SecurityError' || name === 'NotAllowedError') return 'refused';
  if (name === 'InvalidStateError') return 'busy';
  return name === 'NotSupportedError' ? 'gone' : 'failed';
}
