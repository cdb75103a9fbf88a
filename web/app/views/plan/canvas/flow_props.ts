import { kSnap } from '../../../../core/plan/place';

const kGrid: [number, number] = [kSnap, kSnap];

/** What is the same for every drawing. Keys are commands of the studio, not of the library. */
export const kFlowProps = {
  nodesConnectable: false,
  snapToGrid: true,
  snapGrid: kGrid,
  minZoom: 0.1,
  maxZoom: 2,
  deleteKeyCode: null,
  selectionKeyCode: 'Shift',
  multiSelectionKeyCode: ['Control', 'Meta', 'Shift'],
  zoomActivationKeyCode: null,
  panActivationKeyCode: null,
  zoomOnDoubleClick: false,
  // The name of the library is in the licences.
  proOptions: { hideAttribution: true },
};
